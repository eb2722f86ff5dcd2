// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The stationary bootstrap against what its definition and theory say.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "calibration/block_bootstrap.hpp"

namespace isotach::calibration {
namespace {

// Of 200 x 500 draws an index is followed by the next with probability 1 - 1/b + 1/(b n), give or take four
// standard errors; every index is drawn as often as another.
TEST(ResampleBlocks, FollowTheirDefinition) {
  constexpr std::size_t kCount = 500;
  constexpr int kResamples = 200;
  for (const std::size_t block : {1U, 5U, 25U}) {
    std::mt19937_64 generator(3);
    int follows = 0;
    std::vector<int> drawn(kCount);
    for (int resample = 0; resample < kResamples; ++resample) {
      const auto indices = resample_blocks(kCount, block, generator);
      ASSERT_EQ(indices.size(), kCount);
      for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_LT(indices[i], kCount);
        ++drawn[indices[i]];
        if (i > 0 && indices[i] == (indices[i - 1] + 1) % kCount) ++follows;
      }
    }
    const double b = static_cast<double>(block);
    const double expected = 1.0 - 1.0 / b + 1.0 / (b * kCount);
    const double pairs = kResamples * (kCount - 1.0);
    EXPECT_NEAR(follows / pairs, expected, 4.0 * std::sqrt(expected * (1.0 - expected) / pairs) + 1e-12)
        << block;
    double spread = 0.0;
    for (const int times : drawn) spread += std::pow(times - double{kResamples}, 2) / kCount;
    // an index is drawn by whole blocks of the same resample hardly more than once: nearly Poisson
    EXPECT_NEAR(spread, kResamples, 0.4 * kResamples) << block;
  }
}

// Theory: the mean of n values of an AR(1) process has the variance sigma^2 (1 + rho)/(1 - rho)/n; the
// bootstrap finds it within the error that its blocks leave (a quarter, on average over 40 series), single
// values a third.
TEST(ResampleBlocks, FindTheVarianceOfACorrelatedMean) {
  constexpr double kRho = 0.5;
  constexpr std::size_t kCount = 500;
  const std::size_t block = block_length(kRho, kCount);
  std::mt19937_64 generator(9);
  std::normal_distribution<double> normal;
  const auto ratio_to_theory = [&](std::size_t length) {
    double ratio = 0.0;
    for (int series = 0; series < 40; ++series) {
      std::vector<double> values(kCount);
      for (std::size_t i = 0; i < kCount; ++i) {
        values[i] = i == 0 ? normal(generator)
                           : kRho * values[i - 1] + std::sqrt(1.0 - kRho * kRho) * normal(generator);
      }
      double sum = 0.0;
      double squares = 0.0;
      for (int resample = 0; resample < 200; ++resample) {
        double mean = 0.0;
        for (const std::size_t i : resample_blocks(kCount, length, generator)) mean += values[i] / kCount;
        sum += mean / 200.0;
        squares += mean * mean / 200.0;
      }
      ratio += (squares - sum * sum) / ((1.0 + kRho) / (1.0 - kRho) / kCount) / 40.0;
    }
    return ratio;
  };
  EXPECT_NEAR(ratio_to_theory(block), 1.0, 0.25);
  EXPECT_NEAR(ratio_to_theory(1), 1.0 / 3.0, 0.05);
}

TEST(ResampleBlocks, AreRepeatedByTheSameSeed) {
  std::mt19937_64 one(42);
  std::mt19937_64 two(42);
  EXPECT_EQ(resample_blocks(100, 7, one), resample_blocks(100, 7, two));
  EXPECT_TRUE(resample_blocks(0, 7, one).empty());
  EXPECT_THROW((void)resample_blocks(10, 0, one), std::invalid_argument);
}

// By hand: rho = 0.5: (4/3)^(2/3) = 1.2114, times 1000^(1/3) = 12.1; rho = 0.9: (9.4737)^(2/3) = 4.477, 44.8.
TEST(BlockLength, AgreesWithHandArithmetic) {
  EXPECT_EQ(block_length(0.5, 1000), 13U);
  EXPECT_EQ(block_length(0.9, 1000), 45U);
  EXPECT_EQ(block_length(-0.5, 1000), 13U);
  EXPECT_EQ(block_length(0.0, 1000), 1U);
  EXPECT_EQ(block_length(0.995, 1000), 95U);  // at most 3 sqrt(1000)
  EXPECT_EQ(block_length(0.995, 12), 4U);     // at most a third
  EXPECT_EQ(block_length(0.995, 1), 1U);
  // half white: G = 2 0.5 0.8/0.04 = 20, root of D/2 = 0.5 + 0.5 9 = 5: 4^(2/3) = 2.5198, 25.2
  EXPECT_EQ(block_length(0.8, 1000, 0.5), 26U);
  EXPECT_EQ(block_length(0.8, 1000, 0.0), 1U);
  EXPECT_THROW((void)block_length(0.5, 10, 1.5), std::invalid_argument);
  EXPECT_THROW((void)block_length(1.0, 10), std::invalid_argument);
  EXPECT_THROW((void)block_length(std::numeric_limits<double>::quiet_NaN(), 10), std::invalid_argument);
  EXPECT_THROW((void)block_length(0.5, 0), std::invalid_argument);
}

}  // namespace
}  // namespace isotach::calibration
