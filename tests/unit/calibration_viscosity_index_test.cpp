// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// I_v read back from curves that were drawn with it.
#include <gtest/gtest.h>

#include "calibration/viscosity_index.hpp"
#include "tests/unit/calibration_drawn_curve.hpp"

namespace isotach::calibration {
namespace {

using datasets::Stage;
using tests::DrawnCurve;

DrawnCurve virgin_from(double stress) {
  DrawnCurve curve;
  curve.start(curve.y_on_isotach(stress, 1e-6));
  curve.add(0.0, stress, Stage::load);
  return curve;
}

TEST(RateSteps, ScaleStressByTheRatioOfRatesToIv) {
  DrawnCurve curve = virgin_from(1e4);
  curve.compress(4e4, 1e-6, 60);
  curve.compress(8e4, 1e-5, 40);
  curve.compress(1.6e5, 1e-6, 40);
  const auto steps = rate_steps(curve.points());
  ASSERT_EQ(steps.size(), 2U);
  for (const RateStep& step : steps) EXPECT_NEAR(step.I_v, 0.03, 1e-4);
  EXPECT_EQ(steps[0].index, 60U);
  EXPECT_NEAR(steps[0].rate_after / steps[0].rate_before, 10.0, 0.05);
  EXPECT_NEAR(steps[0].logarithmic_step, 0.03 * std::log(10.0), 3e-4);
  EXPECT_LT(steps[1].logarithmic_step, 0.0);
}

TEST(RateSteps, AreNoneOnTheWayBackToTheVirginLine) {
  DrawnCurve curve = virgin_from(1e4);
  curve.compress(1e5, 1e-6, 60);
  curve.swell(5e3, 1e-6, 30, Stage::unload);
  curve.swell(2e4, 1e-6, 30, Stage::load);
  curve.swell(8e4, 1e-5, 30, Stage::load);
  EXPECT_TRUE(rate_steps(curve.points()).empty());
}

TEST(RelaxationLines, FallWithIv) {
  DrawnCurve curve = virgin_from(1e4);
  curve.compress(1e5, 1e-6, 60);
  curve.relax(600.0, 2e5, 40);
  curve.compress(2e5, 1e-6, 60);
  const auto lines = relaxation_lines(curve.points());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].slope, 0.03, 1e-6);
  EXPECT_NEAR(lines[0].offset, 600.0, 0.1);
  EXPECT_EQ(lines[0].first, 61U);
  EXPECT_EQ(lines[0].count, 40U);
  // at the beginning the line has the stress before it
  EXPECT_NEAR(lines[0].intercept - lines[0].slope * std::log(600.0), std::log(1e5), 1e-6);
}

TEST(RelaxationLines, AreOfVirginLoadingAlone) {
  DrawnCurve curve = virgin_from(1e4);
  curve.compress(1e5, 1e-6, 60);
  curve.swell(2e4, 1e-6, 30, Stage::unload);
  curve.relax(600.0, 2e5, 40);
  curve.swell(5e4, 1e-6, 30, Stage::load);
  curve.relax(600.0, 2e5, 40);
  EXPECT_TRUE(relaxation_lines(curve.points()).empty());
}

TEST(CreepLines, FallWithLambdaTimesIv) {
  DrawnCurve curve;
  for (const double stress : {1e4, 2e4, 4e4, 2e4, 4e4}) {  // the last two creep no more than swelling soil
    curve.step(stress, curve.y_on_isotach(stress, 1e-6), 1.0, 86400.0, 60);
  }
  const auto lines = creep_lines(curve.points());
  ASSERT_EQ(lines.size(), 3U);
  for (const TimeLine& line : lines) {
    EXPECT_NEAR(line.slope, 0.15 * 0.03, 1e-6);
    EXPECT_NEAR(line.duration, 86400.0, 1e-6);
  }
  EXPECT_EQ(lines[2].stress, 4e4);
}

// Readings of a coarse load cell repeat at low stress; that is no step.
TEST(CreepLines, AreNoneUnderConstantRate) {
  DrawnCurve curve = virgin_from(1e4);
  curve.compress(1e5, 1e-6, 60);
  std::vector<CurvePoint> points = curve.points();
  for (std::size_t i = 0; i < 8; ++i) points[i].axial_stress = 1e4;
  EXPECT_TRUE(creep_lines(points).empty());
}

TEST(CreepLines, AreThoseOfHoldsToo) {
  DrawnCurve curve = virgin_from(1e4);
  curve.compress(1e5, 1e-6, 60);
  std::vector<CurvePoint> points = curve.points();
  const CurvePoint last = points.back();
  for (int i = 1; i <= 50; ++i) {
    const double t = 1e5 * std::pow(1e-4, 1.0 - i / 50.0);
    const double y = std::log1p(last.void_ratio) - 0.15 * 0.03 * std::log1p(t / 2.0);
    points.push_back({last.time + t, 1e5 * (i % 2 == 0 ? 1.005 : 0.995), std::expm1(y), Stage::hold, 1});
  }
  const auto lines = creep_lines(points);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].slope, 0.15 * 0.03, 2e-6);
  EXPECT_EQ(lines[0].begin, last.time);
}

}  // namespace
}  // namespace isotach::calibration
