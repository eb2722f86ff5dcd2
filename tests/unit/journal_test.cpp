// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The journal gives back what it took, whoever writes and whoever is killed, and refuses what it did not
// make.
#include "journal/journal.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "tests/unit/datasets_files.hpp"
#include "tests/unit/journal_rows.hpp"

namespace isotach::journal {
namespace {

using mpm::RunStatus;

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class JournalTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "fit.journal.sqlite"; }

  datasets::TemporaryFolder folder_;
};

TEST_F(JournalTest, GivesBackWhatItTookToTheLastBit) {
  Evaluation row = row_number(1, RunStatus::not_settled);
  mpm::SlumpResult& result = *row.result;
  const double awkward[] = {0.1 + 0.2, -0.0, std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::max(), std::nextafter(1.0, 2.0)};
  result.outlines.clear();
  for (const double value : awkward) result.outlines.push_back({value, {{value, -value}, {-value, value}}});
  result.history.push_back({1.0, 0.1 + 0.2, -0.0, 3.0, 4.0, 5.0, 6.0, 7.0, 100.0});
  result.initial = {0.1 + 0.2,
                    -0.0,
                    awkward[2],
                    awkward[3],
                    std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::quiet_NaN()};
  result.cell_size = 1.0 / 3.0;
  result.points = 123;
  result.volume_error = awkward[4];
  result.energy_error = -std::numeric_limits<double>::infinity();
  result.steps = 4'000'000'000;
  result.particle_steps = 1e15 + 0.125;
  result.floored = 2;
  {
    Journal journal(file());
    journal.put(row);
  }
  const auto got = Journal(file()).get(row.inputs.key);
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(bytes_of(*got->result), bytes_of(result));
  EXPECT_EQ(got->status, RunStatus::not_settled);
  EXPECT_EQ(got->test, "slump-1");
  EXPECT_EQ(got->seconds, row.seconds);
  EXPECT_EQ(got->time_limit, 10.0);
  EXPECT_EQ(got->inputs.parameters, row.inputs.parameters);
  EXPECT_EQ(got->inputs.setup, row.inputs.setup);
  EXPECT_EQ(got->inputs.version, "test 1");
  EXPECT_EQ(got->created.size(), std::string("2026-01-31T12:00:00Z").size());
}

TEST_F(JournalTest, FailuresKeepStatusAndMessageAndHaveNoResult) {
  Journal journal(file());
  int number = 0;
  for (const RunStatus status : {RunStatus::crashed, RunStatus::timed_out, RunStatus::outside_domain}) {
    const Evaluation row = row_number(++number, status);
    journal.put(row);
    const auto got = journal.get(row.inputs.key);
    ASSERT_TRUE(got.has_value());
    EXPECT_EQ(got->status, status);
    EXPECT_EQ(got->message, "no luck");
    EXPECT_FALSE(got->result.has_value());
  }
  journal.put(row_number(++number));
  journal.put(row_number(++number));
  const mpm::RunCounts counts = journal.counts();
  EXPECT_EQ(counts.total(), 5);
  EXPECT_EQ(counts[RunStatus::ok], 2);
  EXPECT_EQ(counts[RunStatus::timed_out], 1);
  EXPECT_EQ(journal.counts({row_number(0).inputs.setup_key}).total(), 5);
  EXPECT_EQ(journal.counts({"another"}).total(), 0);
  EXPECT_THROW(journal.put(row_number(9, RunStatus::interrupted)), std::invalid_argument);
}

TEST_F(JournalTest, OnlyATimedOutRowGivesWay) {
  Journal journal(file());
  journal.put(row_number(1, RunStatus::timed_out));
  journal.put(row_number(1, RunStatus::ok));
  EXPECT_EQ(journal.get(row_number(1).inputs.key)->status, RunStatus::ok);
  EXPECT_EQ(journal.get(row_number(1).inputs.key)->message, "");
  journal.put(row_number(1, RunStatus::crashed));
  EXPECT_EQ(journal.get(row_number(1).inputs.key)->status, RunStatus::ok);
  EXPECT_EQ(journal.counts().total(), 1);
}

TEST_F(JournalTest, RowsOfASetupComeInTheOrderInWhichTheyWereAdded) {
  Journal journal(file());
  for (const int number : {5, 3, 4}) journal.put(row_number(number));
  std::vector<double> seconds;
  journal.for_each(row_number(0).inputs.setup_key,
                   [&](const Evaluation& row) { seconds.push_back(row.seconds); });
  EXPECT_EQ(seconds, (std::vector<double>{0.1 * 5, 0.1 * 3, 0.1 * 4}));
}

TEST(JournalKey, SeesEveryInputButTheThreads) {
  const model::Parameters<double> mud = tests::seed_mud();
  const mpm::SlumpSetup setup = small_setup();
  std::set<std::string> keys{Inputs(mud, setup, "v1").key};
  std::size_t expected = 1;
  const auto expect_new = [&](const Inputs& inputs) {
    keys.insert(inputs.key);
    EXPECT_EQ(keys.size(), ++expected) << inputs.setup;
  };
  expect_new(Inputs(mud, setup, "v2"));
  for (const model::ParameterInfo& info : model::kParameterTable) {
    const double moved = mud[info.id] == 0.0 ? 1e-300 : std::nextafter(mud[info.id], 2.0 * mud[info.id]);
    expect_new(Inputs(tests::seed_mud_with(info.id, moved), setup, "v1"));
  }
  const auto with = [&](auto&& change) {
    mpm::SlumpSetup other = setup;
    change(other);
    expect_new(Inputs(mud, other, "v1"));
  };
  with([](auto& s) { s.mould.diameter *= 1.0 + 1e-15; });
  with([](auto& s) { s.mould.wall.adhesion = std::numeric_limits<double>::infinity(); });
  with([](auto& s) { s.mould.lift_delay = std::numeric_limits<double>::denorm_min(); });
  with([](auto& s) { s.mould.lift_table = {{0.0, 0.0}, {1.0, 0.05}}; });
  with([](auto& s) { s.mud.strength_rate = 1e-6; });
  with([](auto& s) { s.base.friction.adhesion = 10.0; });
  with([](auto& s) { s.base.slab = mpm::ElasticSlab{}; });
  with([](auto& s) { s.numerics.cell_size = 0.008; });
  with([](auto& s) { s.numerics.inertia_scaling = 1.0; });
  with([](auto& s) { s.numerics.scheme = mpm::Scheme::plain; });
  with([](auto& s) { s.times.push_back(0.3); });
  mpm::SlumpSetup threads = setup;
  threads.numerics.threads = 7;
  EXPECT_TRUE(keys.contains(Inputs(mud, threads, "v1").key));
}

// RFC 4122's name-based UUIDs, here by Python: uuid.uuid5(uuid.NAMESPACE_URL, "v1\n" + parameters + "\n" +
// setup)
TEST(JournalKey, IsTheUuidOfItsText) {
  const Inputs inputs(tests::seed_mud(), small_setup(), "v1");
  EXPECT_EQ(inputs.parameters, R"({"e100":1.358,"lambda":0.154,"kappa":0.0129,"I_v":0.02,"D_r":6.8e-07,)"
                               R"("phi_c":0.24783675378319478,"C_1":0.03,"C_2":0.0,"C_3":0.0,)"
                               R"("lode_dependence":"matsuoka-nakai"})");
  EXPECT_EQ(
      inputs.setup,
      R"({"mould_diameter_m":0.078,"mould_fill_height_m":0.04,"mould_lift_speed_m_per_s":0.06,)"
      R"("mould_wall_adhesion_Pa":0.0,"mould_wall_friction":0.0,"mould_lift_delay_s":0.0,)"
      R"("mould_lift_table_s_m":[],"mud_void_ratio":5.0,"mud_undrained_strength_Pa":null,)"
      R"("mud_strength_rate_per_s":null,"mud_specific_gravity":2.65,"mud_ocr":1.5,)"
      R"("base_adhesion_Pa":"inf","base_friction":0.0,"base_slip_length_m":0.0,)"
      R"("base_elastic":false,"cell_size_m":0.013,"points_per_cell":4,)"
      R"("water_bulk_modulus_Pa":300000.0,"courant":0.8,"tolerance":0.003,)"
      R"("background_viscosity_Pa_s":0.2,"inertia_scaling":100.0,"plain_scheme":false,"times_s":[0.1,0.2],)"
      R"("thixotropy_gain":0.0,"thixotropy_recovery_time_s":1.0,"thixotropy_breakdown":1.0,)"
      R"("yield_stress_Pa":0.0,"consistency_Pa_s_n":0.0,"flow_index":0.5,"draining_rate_per_s":0.0,)"
      R"("void_ratio_gradient":0.0,"surface_tension_N_per_m":0.0,"wander_slot":0})");
  EXPECT_EQ(inputs.key, "4c7ba83b-319e-5b58-afc1-525a72863171");
  EXPECT_EQ(inputs.setup_key, "070db549-bf0f-58b1-88f0-8ff2033c3e62");
}

class JournalRefuses : public JournalTest {
 protected:
  /// Expects the file to be refused by its name and to stay as it is, alone in its folder.
  void expect_refused(std::initializer_list<std::string_view> parts) const {
    const std::string before = content_of(file());
    datasets::expect_input_error([&] { Journal journal(file()); }, parts);
    EXPECT_EQ(content_of(file()), before);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
  }
  void fill() const {
    Journal journal(file());
    for (int number = 0; number < 50; ++number) journal.put(row_number(number));
  }
  void execute(const char* sql) const {
    Database(file(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, 0.0).execute(sql);
  }
};

TEST_F(JournalRefuses, Text) {
  std::ofstream(file()) << "time_s,r_mm,z_mm\n0,0,0\n";
  expect_refused({"fit.journal.sqlite: ", "not a database", "accepted: "});
}

TEST_F(JournalRefuses, AnEmptyFile) {
  std::ofstream(file()).flush();
  expect_refused({"fit.journal.sqlite: ", "another program's"});
}

TEST_F(JournalRefuses, AnotherProgramsDatabase) {
  execute("CREATE TABLE evaluation (id INTEGER)");
  expect_refused({"fit.journal.sqlite: ", "another program's"});
}

TEST_F(JournalRefuses, AnotherSchema) {
  fill();
  execute("PRAGMA user_version = 2");
  expect_refused({"fit.journal.sqlite: ", "version 2", "this program's is 1"});
}

TEST_F(JournalRefuses, ATruncatedFile) {
  fill();
  std::filesystem::resize_file(file(), std::filesystem::file_size(file()) / 2);
  expect_refused({"fit.journal.sqlite: "});
}

TEST_F(JournalRefuses, AFileWithAHole) {
  fill();
  std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file()) / 2));
  stream << std::string(8192, '\xff');
  stream.close();
  expect_refused({"fit.journal.sqlite: "});
}

TEST_F(JournalRefuses, AFolderThatIsNotThere) {
  datasets::expect_input_error([&] { Journal journal(folder_.path() / "none" / "fit.sqlite"); },
                               {"none/fit.sqlite: ", "cannot be made"});
}

class JournalModes : public JournalTest, public testing::WithParamInterface<JournalMode> {
 protected:
  [[nodiscard]] static JournalOptions options() {
    JournalOptions result;
    result.mode = GetParam();
    result.synchronous = Synchronous::normal;
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(Modes, JournalModes, testing::Values(JournalMode::rollback, JournalMode::wal),
                         [](const auto& mode) {
                           return mode.param == JournalMode::wal ? "Wal" : "Rollback";
                         });

TEST_P(JournalModes, ProcessesThatWriteAtOnceLoseNothing) {
  constexpr int kProcesses = 3;
  constexpr int kRows = 40;
  pid_t children[kProcesses];
  for (int process = 0; process < kProcesses; ++process) {
    children[process] = fork();
    ASSERT_GE(children[process], 0);
    if (children[process] != 0) continue;
    int code = 1;
    try {
      Journal journal(file(), options());  // one of them makes it
      // half of the rows are everybody's
      for (int i = 0; i < kRows; ++i) journal.put(row_number(i % 2 == 0 ? i : 1000 * (process + 1) + i));
      code = 0;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    _exit(code);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  const Journal journal(file(), options());
  EXPECT_EQ(journal.counts().total(), kRows / 2 + kProcesses * kRows / 2);
  for (int process = 0; process < kProcesses; ++process) {
    for (int i = 1; i < kRows; i += 2) {
      const Evaluation row = row_number(1000 * (process + 1) + i);
      const auto got = journal.get(row.inputs.key);
      ASSERT_TRUE(got.has_value());
      EXPECT_EQ(bytes_of(*got->result), bytes_of(*row.result));
    }
  }
}

TEST_P(JournalModes, AKilledWriterLosesNothingItHadPut) {
  for (const int rows_before_kill : {1, 2, 7, 20}) {
    std::filesystem::remove(file());
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      Journal journal(file(), options());
      for (int number = 0;; ++number) {
        journal.put(row_number(number));
        if (write(ends[1], "x", 1) != 1) _exit(1);
      }
    }
    close(ends[1]);
    char done = 0;
    for (int i = 0; i < rows_before_kill; ++i) ASSERT_EQ(read(ends[0], &done, 1), 1);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(ends[0]);
    const Journal journal(file(), options());
    for (int number = 0; number < rows_before_kill; ++number) {
      const auto got = journal.get(row_number(number).inputs.key);
      ASSERT_TRUE(got.has_value()) << number << " of " << rows_before_kill;
      EXPECT_EQ(bytes_of(*got->result), bytes_of(*row_number(number).result));
    }
  }
}

}  // namespace
}  // namespace isotach::journal
