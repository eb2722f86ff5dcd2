// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the progress line, on a clock of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <sstream>
#include <thread>
#include <vector>

#include "reports/terminal_progress.hpp"

namespace isotach::reports {
namespace {

class ProgressTest : public ::testing::Test {
 protected:
  [[nodiscard]] ProgressOutput log() {
    return {&out_, false, 80, [this] { return now_; }};
  }
  [[nodiscard]] ProgressOutput terminal(int columns = 80) {
    return {&out_, true, columns, [this] { return now_; }};
  }

  std::ostringstream out_;
  double now_ = 1000.0;
};

TEST_F(ProgressTest, LogHasALineEveryTenSeconds) {
  {
    Progress progress("fit", log());
    for (int i = 0; i <= 25; ++i) {
      now_ = 1000.0 + i;
      progress.update(i / 50.0, "run");
    }
    progress.finish();
  }
  EXPECT_EQ(out_.str(),
            "fit   20 %  run  (10 s, about 40 s left)\n"
            "fit   40 %  run  (20 s, about 30 s left)\n"
            "fit  done in 25 s\n");
}

TEST_F(ProgressTest, ShortWorkLeavesNoLineInALog) {
  Progress progress("fit", log());
  now_ += 3.0;
  progress.update(0.5);
  progress.finish();
  EXPECT_EQ(out_.str(), "");
}

TEST_F(ProgressTest, TerminalLineIsRewrittenAtMostFiveTimesASecond) {
  {
    Progress progress("fit", terminal());
    for (int i = 0; i < 100; ++i) {
      now_ = 1000.0 + i * 0.01;
      progress.update(0.5);
    }
  }
  // At 0, 0.2, 0.4, 0.6 and 0.8 s; rounding of the clock may move one of them beyond the end.
  const std::string text = out_.str();
  const auto lines = std::count(text.begin(), text.end(), '\r');
  EXPECT_GE(lines, 4);
  EXPECT_LE(lines, 5);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.back(), '\n');
}

TEST_F(ProgressTest, LineFitsTheTerminalInCharactersNotBytes) {
  Progress progress("σσσσσσσσσσ", terminal(9));
  progress.update(0.5);
  EXPECT_EQ(out_.str(), "\rσσσσσσσσ\x1b[K");
}

TEST_F(ProgressTest, FractionsAreClampedAndUnknownOnesNotShown) {
  Progress progress("fit", log());
  now_ += 10.0;
  progress.update(1.7);
  now_ += 10.0;
  progress.update(-3.0);
  now_ += 10.0;
  progress.update(std::numeric_limits<double>::quiet_NaN(), "searching");
  EXPECT_EQ(out_.str(), "fit  100 %  (10 s, about 0 s left)\nfit    0 %  (20 s)\nfit  searching  (30 s)\n");
}

TEST_F(ProgressTest, NothingFollowsFinish) {
  Progress progress("fit", log());
  now_ += 10.0;
  progress.update(0.5);
  progress.finish();
  const std::string before = out_.str();
  now_ += 10.0;
  progress.update(0.9);
  progress.finish();
  EXPECT_EQ(out_.str(), before);
}

TEST_F(ProgressTest, QuietPrintsNothing) {
  testing::internal::CaptureStderr();
  {
    Progress progress("fit", true);
    progress.update(0.5);
    progress.finish();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ProgressTest, LinesOfManyThreadsStayWhole) {
  std::atomic<int> ticks = 0;
  ProgressOutput output = log();
  output.clock = [&ticks] { return 10.0 * ticks++; };  // every call is due
  {
    Progress progress("fit", output);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&progress] {
        for (int k = 0; k < 100; ++k) progress.update(0.0, "run");
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  std::istringstream lines(out_.str());
  std::string line;
  int count = 0;
  for (; std::getline(lines, line); ++count) {
    EXPECT_TRUE(line.starts_with("fit    0 %  run  (") && line.ends_with(")")) << line;
  }
  EXPECT_EQ(count, 400);
}

}  // namespace
}  // namespace isotach::reports
