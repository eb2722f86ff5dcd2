// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Lines through compression curves whose slopes are known because they were drawn with them.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "calibration/compression_curve.hpp"
#include "calibration/rate_blocks.hpp"
#include "tests/unit/calibration_drawn_curve.hpp"

namespace isotach::calibration {
namespace {

using datasets::Stage;
using tests::DrawnCurve;

constexpr double kPi = std::numbers::pi;

/// Swelling line up to 40 kPa, virgin to 200 kPa, back to 20 kPa, up again to 800 kPa.
DrawnCurve unload_reload() {
  DrawnCurve curve;
  curve.start(curve.y_on_isotach(4e4, 1e-6) + curve.kappa0 * std::log(4e4 / 4e3));
  curve.add(0.0, 4e3, Stage::load);
  curve.swell(4e4, 1e-6, 20, Stage::load);
  curve.compress(2e5, 1e-6, 60);
  curve.swell(2e4, 1e-6, 30, Stage::unload);
  curve.swell(2e5, 1e-6, 30, Stage::load);
  curve.compress(8e5, 1e-6, 60);
  return curve;
}

TEST(RobustLine, IsNotTurnedByAFewBadReadings) {
  DrawnCurve curve;
  curve.start(curve.y_on_isotach(1e4, 1e-6));
  curve.compress(1e5, 1e-6, 50);
  std::vector<CurvePoint> points = curve.points();
  for (const std::size_t bad : {3U, 20U, 49U}) points[bad].axial_stress *= 1.3;
  const auto line = robust_line(points);
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(line->slope, -0.15, 1e-6);
  EXPECT_NEAR(line->at(1e5), std::log(2.4), 1e-6);
  EXPECT_EQ(line->points, 50U);
}

TEST(RobustLine, NeedsTwoStresses) {
  EXPECT_FALSE(robust_line({}).has_value());
  const std::vector<CurvePoint> same(4, {0.0, 1e4, 1.0, Stage::load, 0});
  EXPECT_FALSE(robust_line(same).has_value());
}

TEST(VirginLine, IsTheUpperReloadingBranch) {
  const auto virgin = virgin_line(unload_reload().points());
  ASSERT_TRUE(virgin.has_value()) << virgin.error();
  EXPECT_NEAR(virgin->line.slope, -0.15, 1e-9);
  EXPECT_NEAR(virgin->line.at(1e5), std::log(2.4), 1e-9);
  EXPECT_NEAR(virgin->line.to_stress, 8e5, 1.0);
  EXPECT_GT(virgin->line.from_stress, 2.6e5);  // 1.3 times 200 kPa
}

// A slow reloading below yield is long and flat; the steep branch counts.
TEST(VirginLine, IsNotALongFlatBranch) {
  DrawnCurve curve;
  curve.start(curve.y_on_isotach(3e5, 1e-6) + curve.kappa0 * std::log(3e5 / 1e3));
  curve.add(0.0, 1e3, Stage::load);
  curve.swell(2e5, 1e-6, 60, Stage::load);
  curve.swell(1e4, 1e-6, 30, Stage::unload);
  curve.swell(3e5, 1e-6, 30, Stage::load);
  curve.compress(7e5, 1e-6, 30);
  const auto virgin = virgin_line(curve.points());
  ASSERT_TRUE(virgin.has_value()) << virgin.error();
  EXPECT_NEAR(virgin->line.slope, -0.15, 1e-9);
}

// Two rates: one line through both would be steeper by 0.03 ln 10 over the span; each alone has lambda.
TEST(VirginLine, IsOfOneRate) {
  DrawnCurve curve;
  curve.start(curve.y_on_isotach(1e4, 1e-6));
  curve.add(0.0, 1e4, Stage::load);
  curve.compress(4e4, 1e-6, 60);
  curve.compress(2e5, 1e-5, 80);
  const auto virgin = virgin_line(curve.points());
  ASSERT_TRUE(virgin.has_value()) << virgin.error();
  EXPECT_NEAR(virgin->line.slope, -0.15, 1e-9);
  EXPECT_NEAR(virgin->rate, 1e-5, 2e-8);
  EXPECT_NEAR(virgin->line.at(curve.isotach(std::log(2.4), 1e-5)), std::log(2.4), 1e-6);
}

// The last readings of steps with the same creep lie on a line of slope lambda.
TEST(VirginLine, GoesThroughTheEndsOfSteps) {
  DrawnCurve curve;
  for (const double stress : {1e4, 2e4, 4e4, 8e4, 1.6e5}) {
    curve.step(stress, curve.y_on_isotach(stress, 1e-6), 60.0, 86400.0, 40);
  }
  const auto virgin = virgin_line(curve.points());
  ASSERT_TRUE(virgin.has_value()) << virgin.error();
  EXPECT_NEAR(virgin->line.slope, -0.15, 1e-9);
  EXPECT_EQ(virgin->line.points, 3U);
  EXPECT_EQ(virgin->rate, 0.0);
  EXPECT_EQ(without_creep(curve.points()).size(), 5U);
}

TEST(VirginLine, SaysWhyItCannotBe) {
  DrawnCurve curve;
  curve.add(0.0, 1e4, Stage::load);
  curve.add(1.0, 2e4, Stage::load);
  const auto virgin = virgin_line(curve.points());
  ASSERT_FALSE(virgin.has_value());
  EXPECT_EQ(virgin.error(), "too few points of virgin loading: 2, at least 3 are needed");
}

TEST(SwellingLines, LeaveOutTheBendAtTheReversal) {
  DrawnCurve curve = unload_reload();
  std::vector<CurvePoint> points = curve.points();
  for (CurvePoint& point : points) {  // creep goes on while the stress comes down from 200 to 140 kPa
    if (point.stage == Stage::unload && point.axial_stress > 1.4e5) point.void_ratio -= 0.01;
  }
  const auto lines = swelling_lines(points);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].slope, -0.01, 1e-9);
  EXPECT_LE(lines[0].to_stress, 1.2e5);
}

TEST(SwellingLines, TakeASingleStepWithThePointBeforeIt) {
  const std::vector<CurvePoint> points{
      {0.0, 1e5, 1.0, Stage::load, 0},
      {1.0, 4e5, 0.8, Stage::load, 0},
      {2.0, 1e5, std::expm1(std::log(1.8) + 0.02 * std::log(4.0)), Stage::unload, 1}};
  const auto lines = swelling_lines(points);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].slope, -0.02, 1e-12);
}

// By hand, phi_c 30 deg: a = sqrt3 2.5/(sqrt2) = 3.0619, a^2 = 9.375; K0 = 0.5: (2 + 4.6875)/4.125. At K0 = 1
// the axial stress is the mean stress, and the factor (3 + a^2/3)/(1 + a^2/3) = 6.125/4.125.
TEST(IsotropicSwellingIndex, AgreesWithHandArithmetic) {
  EXPECT_NEAR(isotropic_swelling_index(0.01, kPi / 6.0, 0.5), 0.01 * 6.6875 / 4.125, 1e-15);
  EXPECT_NEAR(isotropic_swelling_index(0.01, kPi / 6.0, 1.0), 0.01 * 6.125 / 4.125, 1e-15);
  EXPECT_THROW((void)isotropic_swelling_index(0.0, 0.3, 0.5), std::invalid_argument);
  EXPECT_THROW((void)isotropic_swelling_index(0.01, 0.0, 0.5), std::invalid_argument);
  EXPECT_THROW((void)isotropic_swelling_index(0.01, 0.3, std::numeric_limits<double>::quiet_NaN()),
               std::invalid_argument);
}

TEST(RateBlocks, PartLoadingWhereTheSpeedChanges) {
  DrawnCurve curve;
  curve.start(curve.y_on_isotach(1e4, 1e-6));
  curve.add(0.0, 1e4, Stage::load);
  curve.compress(4e4, 1e-6, 60);
  curve.compress(8e4, 1e-5, 40);
  curve.swell(1e4, 1e-6, 20, Stage::unload);
  curve.swell(8e4, 1e-5, 20, Stage::load);
  curve.compress(1.2e5, 1e-5, 40);
  const auto blocks = rate_blocks(curve.points());
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[0].first + blocks[0].count - 1, 60U);
  EXPECT_EQ(blocks[1].first, 60U);
  EXPECT_NEAR(blocks[0].rate, 1e-6, 1e-10);
  EXPECT_NEAR(blocks[1].rate, 1e-5, 1e-9);
  EXPECT_EQ(blocks[2].first, 121U);
}

TEST(CompressionCurve, RejectsWhatIsNone) {
  const CurvePoint good{1.0, 1e4, 1.0, Stage::load, 0};
  const auto rejected = [&](auto change) {
    std::vector<CurvePoint> points{{0.0, 5e3, 1.1, Stage::load, 0}, good};
    change(points[1]);
    EXPECT_THROW(require_curve(points), std::invalid_argument);
  };
  rejected([](CurvePoint& p) { p.time = 0.0; });
  rejected([](CurvePoint& p) { p.axial_stress = 0.0; });
  rejected([](CurvePoint& p) { p.void_ratio = -1.0; });
  rejected([](CurvePoint& p) { p.void_ratio = std::numeric_limits<double>::quiet_NaN(); });
  rejected([](CurvePoint& p) { p.stage = Stage::unload; });
  rejected([](CurvePoint& p) { p.segment = 1; });
}

}  // namespace
}  // namespace isotach::calibration
