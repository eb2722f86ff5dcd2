// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of residuals against hand arithmetic, and their size under noise.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "calibration/residual_tests.hpp"

namespace isotach::calibration {
namespace {

// By hand: signs ++--+-, n+ = n- = 3: mean 1 + 18/6 = 4, variance 18 (18 - 6)/(36 5) = 1.2.
TEST(RunsTest, AgreesWithHandArithmetic) {
  const auto test = runs_test(std::vector{0.3, 0.1, -2.0, -0.1, 0.0, 5.0, -1.0});  // the zero has no sign
  EXPECT_EQ(test.runs, 4U);
  EXPECT_DOUBLE_EQ(test.expected, 4.0);
  EXPECT_EQ(test.z, 0.0);
  EXPECT_EQ(test.p_value, 1.0);
  const auto trend = runs_test(std::vector{1.0, 1.0, 1.0, -1.0, -1.0, -1.0});
  EXPECT_EQ(trend.runs, 2U);
  EXPECT_NEAR(trend.z, -2.0 / std::sqrt(1.2), 1e-14);
  EXPECT_NEAR(trend.p_value, 0.0678892, 1e-7);  // erfc(1.825742/sqrt 2)
}

TEST(RunsTest, OneSignHasTheProbabilityOfCoins) {
  const auto test = runs_test(std::vector(10, -0.7));
  EXPECT_EQ(test.runs, 1U);
  EXPECT_DOUBLE_EQ(test.expected, 5.5);
  EXPECT_DOUBLE_EQ(test.z, -3.0);
  EXPECT_DOUBLE_EQ(test.p_value, 2.0 / 1024.0);
}

TEST(RunsTest, FindsNothingOddInTooFewValues) {
  for (const std::vector<double>& few : {std::vector<double>{}, {0.0, 0.0}, {1.0}, {1.0, -1.0}}) {
    const auto test = runs_test(few);
    EXPECT_EQ(test.z, 0.0);
    EXPECT_EQ(test.p_value, 1.0);
    EXPECT_EQ(static_cast<double>(test.runs), test.expected);
  }
}

// By hand: r = 1, 2, -1, 2: squares 10; lag 1: 2 - 2 - 2 = -2; lag 2: -1 + 4 = 3; lag 3: 2.
TEST(Autocorrelation, AgreesWithHandArithmetic) {
  const std::vector<double> r{1.0, 2.0, -1.0, 2.0};
  EXPECT_DOUBLE_EQ(autocorrelation(r, 0), 1.0);
  EXPECT_DOUBLE_EQ(autocorrelation(r, 1), -0.2);
  EXPECT_DOUBLE_EQ(autocorrelation(r, 2), 0.3);
  EXPECT_DOUBLE_EQ(autocorrelation(r, 3), 0.2);
  EXPECT_EQ(autocorrelation(r, 4), 0.0);
  EXPECT_EQ(autocorrelation(std::vector(5, 0.0), 1), 0.0);
  EXPECT_DOUBLE_EQ(autocorrelation(std::vector{1e-200, 2e-200, -1e-200, 2e-200}, 1), -0.2);
}

// By hand, same r: Q = 4 6 (0.04/3 + 0.09/2) = 1.4; of two degrees P(X > Q) = exp(-Q/2).
TEST(LjungBox, AgreesWithHandArithmetic) {
  const auto test = ljung_box(std::vector{1.0, 2.0, -1.0, 2.0}, 10);
  EXPECT_EQ(test.lags, 2);  // clipped
  EXPECT_NEAR(test.statistic, 1.4, 1e-14);
  EXPECT_NEAR(test.p_value, std::exp(-0.7), 1e-14);
}

TEST(LjungBox, HasNothingToSayOfTooFewValues) {
  for (const std::size_t count : {0U, 1U}) {
    const auto test = ljung_box(std::vector(count, 1.0), 5);
    EXPECT_EQ(test.lags, 0);
    EXPECT_EQ(test.p_value, 1.0);
  }
  EXPECT_EQ(ljung_box(std::vector(8, 0.0), 3).p_value, 1.0);
}

// Of 2000 series of noise 5 % are to be rejected at 5 %, give or take 4 sqrt(0.05 0.95/2000) = 1.9 %; an
// AR(1) series of rho 0.5 practically always.
TEST(ResidualTests, RejectNoiseAsOftenAsTheyClaim) {
  std::mt19937_64 generator(20240701);
  std::normal_distribution<double> normal;
  constexpr int kSeries = 2000;
  int runs_rejected = 0;
  int ljung_box_rejected = 0;
  int correlated_rejected = 0;
  for (int series = 0; series < kSeries; ++series) {
    std::vector<double> noise(300);
    std::vector<double> correlated(300);
    for (std::size_t i = 0; i < noise.size(); ++i) {
      noise[i] = normal(generator);
      correlated[i] = noise[i] + (i == 0 ? 0.0 : 0.5 * correlated[i - 1]);
    }
    if (runs_test(noise).p_value < 0.05) ++runs_rejected;
    if (ljung_box(noise, 10).p_value < 0.05) ++ljung_box_rejected;
    if (ljung_box(correlated, 10).p_value < 0.05 && runs_test(correlated).p_value < 0.05)
      ++correlated_rejected;
  }
  EXPECT_NEAR(runs_rejected / double{kSeries}, 0.05, 0.019);
  EXPECT_NEAR(ljung_box_rejected / double{kSeries}, 0.05, 0.019);
  EXPECT_GT(correlated_rejected, 1900);
}

TEST(ResidualTests, RejectWhatIsNoResidualOrLag) {
  const std::vector<double> bad{1.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW((void)runs_test(bad), std::invalid_argument);
  EXPECT_THROW((void)autocorrelation(bad, 1), std::invalid_argument);
  EXPECT_THROW((void)ljung_box(bad, 1), std::invalid_argument);
  EXPECT_THROW((void)autocorrelation(std::vector{1.0, 2.0}, -1), std::invalid_argument);
  EXPECT_THROW((void)ljung_box(std::vector{1.0, 2.0}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace isotach::calibration
