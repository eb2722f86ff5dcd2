// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Twenty fits, each killed at a random moment and started again: all end with the answer of the fit that was
// left alone, to the last digit.
#include <chrono>
#include <random>
#include <thread>

#include "tests/consumer/small_slump_fit.hpp"

namespace isotach::consumer {
namespace {

class KilledFit : public SmallSlumpFit {};

TEST_F(KilledFit, AtTwentyRandomMomentsEndsWithTheSameAnswer) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  ASSERT_EQ(run(fit("whole")).code, 0);
  const std::chrono::duration<double> whole = Clock::now() - begin;
  const long all = rows("whole");
  const std::string expected = answer("whole");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> moment(0.0, whole.count());
  int killed = 0;
  for (int k = 0; k < 20; ++k) {
    const std::string out = "parts" + std::to_string(k);
    const double after = moment(random);
    Process process = start(fit(out));
    std::this_thread::sleep_for(std::chrono::duration<double>(after));
    process.signal(SIGKILL);
    if (process.wait().code == -1) ++killed;  // else it was over already
    ASSERT_EQ(run(fit(out)).code, 0) << "killed after " << after << " s";
    EXPECT_EQ(answer(out), expected) << "killed after " << after << " s";
    EXPECT_EQ(rows(out), all) << "killed after " << after << " s";
  }
  EXPECT_GE(killed, 15) << "too many fits were over before they were killed";
}

}  // namespace
}  // namespace isotach::consumer
