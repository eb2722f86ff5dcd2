// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Yield constructions on bilinear curves, whose kink is the yield stress.
#include <gtest/gtest.h>

#include <random>

#include "calibration/yield_stress.hpp"
#include "tests/unit/calibration_drawn_curve.hpp"

namespace isotach::calibration {
namespace {

using datasets::Stage;
using tests::DrawnCurve;

constexpr double kRange = 99.9;

/// Equal steps of ln sigma from 5 to 499 kPa, slope 0.01 up to a kink and 0.15 beyond; scatter of ln(1+e). A
/// load that grows in proportion to time's exponential: the rate jumps at the kink, which is no jump of rate.
std::vector<CurvePoint> bilinear(double kink, int count, double scatter) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<CurvePoint> points;
  for (int i = 0; i < count; ++i) {
    const double stress = 5e3 * std::pow(kRange, static_cast<double>(i) / (count - 1));
    const double slope = stress < kink ? 0.01 : 0.15;
    const double y = 0.9 - slope * std::log(stress / kink) + scatter * normal(generator);
    points.push_back({1e3 * i, stress, std::expm1(y), Stage::load, 0});
  }
  return points;
}

// With the kink on a reading both branches of work are straight exactly: steps of equal ratio make the
// trapezoidal rule's error one factor.
TEST(Becker, FindsTheKinkOfABilinearCurve) {
  for (const int at : {60, 100, 150}) {
    const double kink = 5e3 * std::pow(kRange, at / 200.0);
    const auto yield = becker_yield(bilinear(kink, 201, 0.0));
    ASSERT_TRUE(yield.has_value()) << yield.error();
    EXPECT_NEAR(yield->yield_stress, kink, 1e-6 * kink);
    EXPECT_NEAR(yield->before.slope, 0.01, 1e-4 * 0.01);  // (1 + h^2/12), h = ln(99.9)/200
    EXPECT_NEAR(yield->after.slope, 0.15, 1e-4 * 0.15);
    EXPECT_EQ(yield->points.size(), 201U);
  }
}

// Smoothing over 15 % of the width rounds the kink, so that the construction is a few per cent off.
TEST(Casagrande, FindsTheKinkOfABilinearCurveWithinATenth) {
  for (const double kink : {2e4, 5e4, 1e5}) {
    const auto yield = casagrande_yield(bilinear(kink, 201, 0.0));
    ASSERT_TRUE(yield.has_value()) << yield.error();
    EXPECT_NEAR(yield->yield_stress, kink, 0.1 * kink);
    // as drawn: the bisector starts at the bend and meets the virgin line at the yield stress
    EXPECT_NEAR(yield->bisector.at(yield->bend_stress), yield->bend, 1e-12);
    EXPECT_NEAR(yield->tangent.at(yield->bend_stress), yield->bend, 1e-12);
    EXPECT_NEAR(yield->bisector.at(yield->yield_stress), yield->virgin.at(yield->yield_stress), 1e-12);
    EXPECT_LT(yield->tangent.slope, yield->bisector.slope);
    EXPECT_LT(yield->bisector.slope, 0.0);
  }
}

TEST(YieldStress, IsFoundThroughScatter) {
  const auto points = bilinear(5e4, 201, 5e-4);
  const auto casagrande = casagrande_yield(points);
  const auto becker = becker_yield(points);
  ASSERT_TRUE(casagrande.has_value() && becker.has_value());
  EXPECT_NEAR(casagrande->yield_stress, 5e4, 0.15 * 5e4);
  EXPECT_NEAR(becker->yield_stress, 5e4, 0.05 * 5e4);
}

// Loads that double, as in incremental loading: the kink lies between two, and that is as close as it gets.
TEST(YieldStress, IsFoundBetweenDoubledLoads) {
  std::vector<CurvePoint> points;
  double stress = 5e3;
  for (int i = 0; i < 8; ++i, stress *= 2.0) {
    const double y = 0.9 - (stress < 6e4 ? 0.01 : 0.15) * std::log(stress / 6e4);
    points.push_back({86400.0 * (i + 1), stress, std::expm1(y), Stage::load, 0});
  }
  const auto casagrande = casagrande_yield(points);
  const auto becker = becker_yield(points);
  ASSERT_TRUE(casagrande.has_value()) << casagrande.error();
  ASSERT_TRUE(becker.has_value()) << becker.error();
  for (const double yield : {casagrande->yield_stress, becker->yield_stress}) {
    EXPECT_GT(yield, 4e4);
    EXPECT_LT(yield, 8e4);
  }
}

// A jump of rate lifts the curve by 7 % in stress; neither takes it for a yield.
TEST(YieldStress, IsNoJumpOfRate) {
  DrawnCurve curve;
  curve.start(curve.y_on_isotach(1e4, 1e-6));
  curve.add(0.0, 1e4, Stage::load);
  curve.compress(4e4, 1e-6, 60);
  curve.compress(8e4, 1e-5, 40);
  curve.compress(4e5, 1e-6, 80);
  const auto casagrande = casagrande_yield(curve.points());
  const auto becker = becker_yield(curve.points());
  ASSERT_FALSE(casagrande.has_value());
  ASSERT_FALSE(becker.has_value());
  EXPECT_EQ(casagrande.error(), "the compression curve shows no bend towards the virgin line");
  EXPECT_EQ(becker.error(), "work against stress shows no bend");
}

TEST(YieldStress, NeedsFivePoints) {
  const std::vector<CurvePoint> four = bilinear(5e4, 4, 0.0);
  for (const std::string& why : {casagrande_yield(four).error(), becker_yield(four).error()}) {
    EXPECT_EQ(why, "too few points of virgin loading at the first rate: 4, at least 5 are needed");
  }
  EXPECT_FALSE(becker_yield({}).has_value());
}

TEST(YieldPoints, LeaveOutTheFirstHundredthOfStress) {
  const auto points = yield_points(bilinear(5e4, 201, 0.0));
  EXPECT_EQ(points.size(), 201U);
  std::vector<CurvePoint> seated = bilinear(5e4, 201, 0.0);
  for (std::size_t i = 0; i < 20; ++i) seated[i].axial_stress = 1e2 + static_cast<double>(i);
  EXPECT_EQ(yield_points(seated).size(), 181U);
}

}  // namespace
}  // namespace isotach::calibration
