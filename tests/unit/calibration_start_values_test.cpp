// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Start values from curves drawn with known parameters.
#include <gtest/gtest.h>

#include <stdexcept>

#include "calibration/start_values.hpp"
#include "tests/unit/calibration_drawn_curve.hpp"

namespace isotach::calibration {
namespace {

using datasets::Stage;
using tests::DrawnCurve;

constexpr double kPhi = 0.4;
constexpr double kK0 = 0.6;
constexpr double kE100 = 1.2;

/// A soil whose OCR is 1 at `reference_rate` with e100 = 1.2: p_B = p_B+ there, so that at e100 the axial
/// stress is 100 kPa over p_B+/sigma, which is stated here apart from the program.
DrawnCurve soil(double reference_rate) {
  const double M = 6.0 * std::sin(kPhi) / (3.0 - std::sin(kPhi));
  const double p = (1.0 + 2.0 * kK0) / 3.0;
  const double q = 1.0 - kK0;
  DrawnCurve curve;
  curve.stress_1 = 1e5 / (p + q * q / (M * M * p));
  curve.y_1 = std::log(1.0 + kE100);
  curve.rate_1 = reference_rate;
  return curve;
}

DrawnCurve crs(double reference_rate, double rate) {
  DrawnCurve curve = soil(reference_rate);
  curve.start(curve.y_on_isotach(1e4, rate));
  curve.add(0.0, 1e4, Stage::load);
  curve.compress(4e4, rate, 60);
  curve.compress(8e4, 10.0 * rate, 40);
  curve.swell(8e3, rate, 40, Stage::unload);
  return curve;
}

TEST(StartValues, AreThoseTheCurveWasDrawnWith) {
  const std::vector<std::vector<CurvePoint>> tests{crs(1e-6, 1e-6).points(), crs(1e-6, 4e-6).points()};
  const auto start = start_values(tests, kPhi, kK0, 1e-6);
  ASSERT_TRUE(start.lambda.value && start.kappa.value && start.I_v.value && start.e100.value);
  EXPECT_NEAR(*start.lambda.value, 0.15, 1e-6);
  EXPECT_NEAR(*start.kappa.value, isotropic_swelling_index(0.01, kPhi, kK0), 1e-6);
  EXPECT_NEAR(*start.I_v.value, 0.03, 2e-4);
  EXPECT_NEAR(*start.e100.value, kE100, 2e-4);
  EXPECT_NE(start.e100.source.find("moved to the reference rate"), std::string::npos);
  EXPECT_EQ(start.I_v.source.substr(0, 31), "2 jumps of strain rate (median)");
  ASSERT_EQ(start.tests.size(), 2U);
  EXPECT_TRUE(start.tests[1].virgin.has_value());
}

// Steps: the rate of creep at their end, C_alpha/t, is what e100 is moved from; lambda and I_v as drawn.
TEST(StartValues, ComeFromIncrementalLoadingToo) {
  DrawnCurve curve = soil(1e-6);
  constexpr double kOffset = 1.0;
  // at the beginning of a step's creep the rate is lambda I_v/offset
  const double first_rate = curve.lambda * curve.I_v / kOffset;
  for (const double stress : {1e4, 2e4, 4e4, 8e4, 1.6e5}) {
    curve.step(stress, curve.y_on_isotach(stress, first_rate), kOffset, 86400.0, 60);
  }
  const auto start = start_values(std::vector<std::vector<CurvePoint>>{curve.points()}, kPhi, kK0, 1e-6);
  ASSERT_TRUE(start.lambda.value && start.I_v.value && start.e100.value);
  EXPECT_NEAR(*start.lambda.value, 0.15, 1e-6);
  EXPECT_NEAR(*start.I_v.value, 0.03, 1e-5);
  EXPECT_NEAR(*start.e100.value, kE100, 1e-5);
  EXPECT_FALSE(start.kappa.value.has_value());
  EXPECT_EQ(start.kappa.source, "no unloading branch to draw a swelling line through");
}

TEST(StartValues, PreferRelaxationToNothing) {
  DrawnCurve curve = soil(1e-6);
  curve.start(curve.y_on_isotach(1e4, 1e-6));
  curve.add(0.0, 1e4, Stage::load);
  curve.compress(1e5, 1e-6, 60);
  curve.relax(600.0, 2e5, 40);
  const auto start = start_values(std::vector<std::vector<CurvePoint>>{curve.points()}, kPhi, kK0, 1e-6);
  ASSERT_TRUE(start.I_v.value.has_value());
  EXPECT_NEAR(*start.I_v.value, 0.03, 1e-6);
  EXPECT_EQ(start.I_v.source, "1 relaxation: slope of ln stress against ln time");
}

TEST(StartValues, SayWhatIsMissing) {
  const std::vector<std::vector<CurvePoint>> none{{{0.0, 1e4, 1.0, Stage::load, 0}}};
  const auto start = start_values(none, kPhi, kK0, 1e-6);
  EXPECT_FALSE(start.lambda.value || start.kappa.value || start.I_v.value || start.e100.value);
  EXPECT_EQ(start.lambda.source,
            "no virgin compression line: too few points of virgin loading: 1, at least 3 are needed");
  EXPECT_EQ(start.I_v.source, "no jump of rate, relaxation or creep in virgin compression");
}

TEST(StartValues, KeepKappaBelowLambda) {
  DrawnCurve curve = soil(1e-6);
  curve.kappa0 = 0.12;
  curve.start(curve.y_on_isotach(1e4, 1e-6));
  curve.add(0.0, 1e4, Stage::load);
  curve.compress(1e5, 1e-6, 60);
  curve.swell(1e4, 1e-6, 40, Stage::unload);
  const auto start = start_values(std::vector<std::vector<CurvePoint>>{curve.points()}, kPhi, kK0, 1e-6);
  EXPECT_NEAR(start.kappa.value.value(), 0.075, 1e-6);
  EXPECT_NE(start.kappa.source.find("half of lambda"), std::string::npos);
}

TEST(StartValues, RejectAssumptionsOutOfRange) {
  EXPECT_THROW((void)start_values({}, 0.0, kK0, 1e-6), std::invalid_argument);
  EXPECT_THROW((void)start_values({}, kPhi, 0.0, 1e-6), std::invalid_argument);
  EXPECT_THROW((void)start_values({}, kPhi, 1.5, 1e-6), std::invalid_argument);
  EXPECT_THROW((void)start_values({}, kPhi, kK0, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace isotach::calibration
