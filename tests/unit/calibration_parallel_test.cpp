// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// parallel_for: each index once, in order, no more threads than allowed, exceptions out.
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

#include "calibration/parallel.hpp"

namespace isotach::calibration {
namespace {

class ParallelFor : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(-1, 0, 1, 2, 5));

TEST_P(ParallelFor, CallsEachIndexOnce) {
  std::vector<std::atomic<int>> calls(100);
  parallel_for(calls.size(), GetParam(), [&](std::size_t i) { ++calls[i]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST_P(ParallelFor, NothingToDoIsDone) {
  parallel_for(0, GetParam(), [](std::size_t) { FAIL(); });
}

TEST_P(ParallelFor, ExceptionComesOutAndEndsTheRest) {
  std::atomic<int> calls{0};
  const auto throwing = [&](std::size_t i) {
    ++calls;
    if (i == 3) throw std::runtime_error("task 3");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  try {
    parallel_for(1000, GetParam(), throwing);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "task 3");
  }
  EXPECT_GE(calls, 4);
  EXPECT_LT(calls, 500);
}

TEST_P(ParallelFor, RunsAtMostTheThreadsAllowed) {
  std::atomic<int> running{0};
  std::atomic<int> most{0};
  parallel_for(40, GetParam(), [&](std::size_t) {
    const int now = ++running;
    int seen = most;
    while (now > seen && !most.compare_exchange_weak(seen, now)) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --running;
  });
  EXPECT_LE(most, std::max(1, GetParam()));
  if (GetParam() > 1) {
    EXPECT_GT(most, 1);
  }
}

TEST(ParallelForOrder, OneThreadGoesInOrder) {
  std::vector<std::size_t> order;
  parallel_for(5, 1, [&](std::size_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace isotach::calibration
