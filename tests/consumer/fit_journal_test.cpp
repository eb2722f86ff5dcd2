// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A fit that keeps a journal: killed at any moment and started again it ends with the answer of the fit that
// was left alone.
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "journal/journal.hpp"
#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using datasets::replaced;
using nlohmann::ordered_json;

constexpr std::string_view kStudyHead = R"([material]
e100 = 1.358
lambda = 0.154
kappa = 0.0129
I_v = 0.02
D_r_per_s = 6.8e-7
phi_c_deg = 14.2
C_1 = 0.03
[fit]
slump = ["I_v"]
[numerics]
cell_size_mm = 8.0
)";

constexpr std::string_view kStudyTest = R"([[slump]]
name = "NAME"
data = "NAME.csv"
noise = { outline_mm = 0.5, lifting_mm = 0.5 }
[slump.mould]
diameter_mm = 78.0
fill_height_mm = 40.0
lift_speed_m_per_s = 0.06
[slump.mud]
void_ratio = 5.0
[slump.base]
kind = "rough"
)";

class JournalOfAFit : public ConsumerTest {
 protected:
  /// A study of two tests, of which the data are simulated slumps at another I_v.
  void SetUp() override {
    std::string study(kStudyHead);
    for (const char* name : {"one", "two"}) {
      const char* void_ratio = name == std::string_view("one") ? "5.0" : "4.7";
      std::string slump =
          replaced(std::string(kTinySlump), "void_ratio = 3.891", std::string("void_ratio = ") + void_ratio);
      slump = replaced(slump, "cell_size_mm = 13.0", "cell_size_mm = 8.0");
      slump = replaced(slump, "times_s = [0.1, 0.3]", "times_s = [0.1, 1.0]");
      write("slump.toml", replaced(slump, "I_v = 0.02", "I_v = 0.03"));
      ASSERT_EQ(run({"slump", "slump.toml", "--out", "data", "--quiet"}).code, 0);
      std::filesystem::rename(folder() / "data/outlines.csv", folder() / (std::string(name) + ".csv"));
      std::string test = replaced(std::string(kStudyTest), "\"NAME\"", std::string("\"") + name + "\"");
      test = replaced(test, "NAME.csv", std::string(name) + ".csv");
      study += replaced(test, "void_ratio = 5.0", std::string("void_ratio = ") + void_ratio);
    }
    write("study.toml", study);
  }

  [[nodiscard]] std::vector<std::string> fit(const std::string& out,
                                             std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"fit-slump", "study.toml", "--out", out, "--threads", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// result.json without the seconds, which are the only thing that may differ.
  [[nodiscard]] std::string answer(const std::string& out) const {
    ordered_json json = ordered_json::parse(contents(out + "/result.json"));
    EXPECT_TRUE(json.contains("parameters"));
    json.erase("seconds");
    return json.dump(1);
  }
  [[nodiscard]] long rows(const std::string& out) const {
    const std::filesystem::path file = folder() / (out + ".journal.sqlite");
    return std::filesystem::exists(file) ? journal::Journal(file).counts().total() : 0;
  }
};

TEST_F(JournalOfAFit, TheAnswerIsTheSameWithoutWithAnEmptyAndWithAFullJournal) {
  ASSERT_EQ(run(fit("none", {"--no-journal"})).code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder() / "none.journal.sqlite"));
  const Ended first = run(fit("kept"));
  ASSERT_EQ(first.code, 0);
  EXPECT_NE(first.err.find("kept.journal.sqlite holds 0 simulations"), std::string::npos) << first.err;
  const long held = rows("kept");
  EXPECT_GT(held, 10);
  const std::string once = answer("kept");
  const Ended second = run(fit("kept"));
  ASSERT_EQ(second.code, 0);
  // those with other cells or points, which tell the error of simulations, are none of its tests
  EXPECT_NE(second.err.find("of this study's tests, " + std::to_string(held) + " in all"), std::string::npos)
      << second.err;
  EXPECT_EQ(rows("kept"), held) << "nothing was left to simulate";
  EXPECT_EQ(once, answer("none"));
  EXPECT_EQ(answer("kept"), answer("none"));
  ASSERT_EQ(run(fit("elsewhere", {"--journal", "kept.journal.sqlite"})).code, 0);
  EXPECT_EQ(answer("elsewhere"), answer("none"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "elsewhere.journal.sqlite"));
}

TEST_F(JournalOfAFit, KilledAgainAndAgainItEndsWithTheSameAnswer) {
  ASSERT_EQ(run(fit("whole")).code, 0);
  const long all = rows("whole");
  long kept = 0;
  int kills = 0;
  for (const long wanted : {1L, 3L, all / 3, all / 2, all - 2}) {
    Process process = start(fit("parts"));
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (rows("parts") < wanted && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    process.signal(SIGKILL);
    if (process.wait().code == -1) ++kills;  // else it was over already
    const long now = rows("parts");
    EXPECT_GE(now, std::max(kept, wanted));
    kept = now;
  }
  EXPECT_GE(kills, 3) << "the fit was over before it was killed";
  ASSERT_EQ(run(fit("parts")).code, 0);
  EXPECT_EQ(answer("parts"), answer("whole"));
  EXPECT_EQ(rows("parts"), all) << "what was in flight was run again, nothing else";
}

TEST_F(JournalOfAFit, TimeOutsAreCountedAndEndTheFitVisibly) {
  const Ended ended = run(fit("late", {"--time-limit", "0.001"}));
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("limit of 0.001 s of wall time"), std::string::npos) << ended.err;
  const mpm::RunCounts counts = journal::Journal(folder() / "late.journal.sqlite").counts();
  EXPECT_EQ(counts[mpm::RunStatus::timed_out], counts.total());
  EXPECT_GE(counts.total(), 2);
}

TEST_F(JournalOfAFit, AForeignFileIsRefusedAndLeftAlone) {
  write("foreign.sqlite", "mine");
  expect_refused({"fit-slump", "study.toml", "--journal", "foreign.sqlite"}, {"foreign.sqlite: ", "journal"});
  EXPECT_EQ(contents("foreign.sqlite"), "mine");
}

}  // namespace
}  // namespace isotach::consumer
