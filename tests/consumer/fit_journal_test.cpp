// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A fit that keeps a journal: killed at any moment and started again it ends with the answer of the fit that
// was left alone.
#include <chrono>
#include <thread>

#include "tests/consumer/small_slump_fit.hpp"

namespace isotach::consumer {
namespace {

class JournalOfAFit : public SmallSlumpFit {};

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
