// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A fit by two processes of mpirun is the fit by one, also where one of them dies on the way.
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <map>
#include <optional>
#include <thread>

#include "journal/sqlite.hpp"
#include "tests/consumer/small_slump_fit.hpp"

namespace isotach::consumer {
namespace {

long count(const std::string& text, std::string_view part) {
  long found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The process of that rank that `launcher` started on this machine, if it is there.
std::optional<pid_t> process_of_rank(int rank, pid_t launcher) {
  const std::string variable = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (!std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
      continue;
    const std::string status = content_of(entry.path() / "status");
    const std::string environment = '\0' + content_of(entry.path() / "environ");
    if (status.find("PPid:\t" + std::to_string(launcher) + '\n') != std::string::npos &&
        environment.find('\0' + variable + '\0') != std::string::npos) {
      return std::stoi(name);
    }
  }
  return std::nullopt;
}

class Cluster : public SmallSlumpFit {
 protected:
  static void SetUpTestSuite() {
    // whoever runs the tests
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("ASAN_OPTIONS", "detect_leaks=0", 0);  // Open MPI's own at its end
  }
  [[nodiscard]] static std::vector<std::string> two_ranks() {
    return {ISOTACH_MPIEXEC, "-n", "2", "--oversubscribe", "--bind-to", "none"};
  }
  [[nodiscard]] Ended run_on_two(const std::vector<std::string>& arguments) const {
    return start(arguments, two_ranks()).wait();
  }
  /// Until the journal of a fit that is under way has so many rows.
  void wait_for_rows(const std::string& out, long wanted) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (rows(out) < wanted && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  /// Each row by its key, the bytes of its result included; not when it was made and what it took.
  [[nodiscard]] std::map<std::string, std::string> rows_by_key(const std::string& out) const {
    journal::Database database(folder() / (out + ".journal.sqlite"), SQLITE_OPEN_READWRITE, 10.0);
    journal::Statement row(
        database,
        "SELECT key, setup_key || test || parameters || setup || version || status || message "
        "|| hex(outlines) || hex(history) || measures FROM evaluation");
    std::map<std::string, std::string> rows;
    while (row.step()) rows[row.text(0)] = row.text(1);
    return rows;
  }
};

TEST_F(Cluster, TwoRanksGiveTheAnswerAndTheRowsOfOne) {
  ASSERT_EQ(run(fit("one")).code, 0);
  const Ended two = run_on_two(fit("two"));
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_EQ(count(two.err, "simulations: one on each of 2 processes\n"), 1) << two.err;
  EXPECT_EQ(count(two.out, "report: "), 1) << two.out;
  EXPECT_EQ(answer("two"), answer("one"));
  EXPECT_EQ(contents("two/parameters.toml"), contents("one/parameters.toml"));
  const auto rows = rows_by_key("one");
  EXPECT_GT(rows.size(), 10U);
  EXPECT_EQ(rows_by_key("two"), rows);
}

TEST_F(Cluster, AfterTheDeathOfARankTheSameCommandGoesOn) {
  ASSERT_EQ(run(fit("whole")).code, 0);
  const auto rows_of_all = rows_by_key("whole");
  Process process = start(fit("parts"), two_ranks());
  wait_for_rows("parts", 4);
  const auto serving = process_of_rank(1, process.id());
  ASSERT_TRUE(serving.has_value()) << "the fit was over before a rank was killed";
  kill(*serving, SIGKILL);
  EXPECT_NE(process.wait().code, 0) << "the launcher ends them all";
  EXPECT_FALSE(std::filesystem::exists(folder() / "parts"));
  EXPECT_LT(rows("parts"), static_cast<long>(rows_of_all.size()));
  ASSERT_EQ(run_on_two(fit("parts")).code, 0);
  EXPECT_EQ(answer("parts"), answer("whole"));
  EXPECT_EQ(rows_by_key("parts"), rows_of_all);
}

TEST_F(Cluster, AnInterruptOfRankZeroEndsAllAndKeepsWhatIsDone) {
  Process process = start(fit("parts"), two_ranks());
  wait_for_rows("parts", 4);
  const auto leading = process_of_rank(0, process.id());
  ASSERT_TRUE(leading.has_value()) << "the fit was over before it was interrupted";
  kill(*leading, SIGTERM);
  const Ended ended = process.wait();
  EXPECT_EQ(ended.code, 130);
  EXPECT_EQ(count(ended.err, "give the same command again"), 1) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder() / "parts"));
  EXPECT_GE(rows("parts"), 4);
}

TEST_F(Cluster, ATimeOutOnAnotherRankIsAFailureAsItIsHere) {
  const Ended ended = run_on_two(fit("late", {"--time-limit", "0.001"}));
  EXPECT_EQ(ended.code, 3);
  EXPECT_EQ(count(ended.err, "limit of 0.001 s of wall time"), 1) << ended.err;
  const mpm::RunCounts counts = journal::Journal(folder() / "late.journal.sqlite").counts();
  EXPECT_EQ(counts[mpm::RunStatus::timed_out], counts.total());
  EXPECT_GE(counts.total(), 2);
}

// srun's place is taken by mpirun, which starts the same processes.
TEST_F(Cluster, TheJobScriptOfTheDocumentationFits) {
  std::string launcher;
  for (const std::string& word : two_ranks()) launcher += word + " ";
  write("srun", "#!/bin/sh\nshift 2\nexec " + launcher + "\"$@\"\n");
  std::filesystem::permissions(folder() / "srun", std::filesystem::perms::owner_all);
  std::filesystem::create_symlink(ISOTACH_PROGRAM, folder() / "isotach");
  const std::string path = folder().string() + ":" + std::getenv("PATH");
  const Ended ended =
      start_command({"/usr/bin/env", "PATH=" + path, "bash",
                     ISOTACH_SOURCE_DIR "/docs/cluster/fit-slump.sbatch", "study.toml", "out"})
          .wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(answer("out"), "");
  EXPECT_GT(rows("out"), 10);
}

TEST_F(Cluster, BadInputIsToldOnce) {
  write("bad.toml", datasets::replaced(contents("study.toml"), "kappa = 0.0129", "kapa = 0.0129"));
  const std::vector<std::string> before = everything();
  const Ended study = run_on_two({"fit-slump", "bad.toml", "--out", "out"});
  EXPECT_EQ(study.code, 2);
  EXPECT_EQ(count(study.err, "bad.toml"), 1) << study.err;
  const Ended option = run_on_two({"calibrate", "study.toml", "--thread", "2"});
  EXPECT_EQ(option.code, 2);
  EXPECT_EQ(count(option.err, "--thread"), 1) << option.err;
  EXPECT_EQ(everything(), before);
}

// As by the mpirun of another MPI: each of the processes would take itself for the only one.
TEST_F(Cluster, ProcessesThatMpiDoesNotFindAreRefused) {
  const Ended ended = start_command({"/usr/bin/env", "PMI_SIZE=2", ISOTACH_PROGRAM, "fit-slump", "study.toml",
                                     "--out", "out"})
                          .wait();
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(count(ended.err, "2 processes were started together, but MPI finds 1"), 1) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
}

}  // namespace
}  // namespace isotach::consumer
