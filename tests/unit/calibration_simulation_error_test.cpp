// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The error of simulations that are formulas: what other cells and water, and a little of another material,
// do to each outline.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/simulation_error.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::calibration {
namespace {

constexpr double kPerCell = 2e-4;  // m, what a cell more across the radius adds to the radius of the pile
constexpr double kTopples = 3e-3;  // m
constexpr double kRadius = 0.039;  // m

constexpr double kPerWater = 1e-4;  // m, that water four times as stiff takes away
constexpr double kOfC1 = 1e-3;      // m, that C_1 adds for each hundredth

/// A cylinder that each cell more across the radius makes wider, of a slow lift three times as much, and C_1.
/// After ten seconds mud of a larger C_1 than the seed's has toppled where `topples`.
experiments::Simulate cylinders(bool topples) {
  return [topples](const std::string& /*test*/, const model::Parameters<double>& parameters,
                   const mpm::SlumpSetup& setup) -> tl::expected<mpm::SlumpResult, mpm::RunFailure> {
    mpm::SlumpResult result;
    const double cells = std::round(kRadius / setup.numerics.cell_size);
    for (const double time : setup.times) {
      double radius = 0.05 + (setup.mould.lift_speed < 0.03 ? 3.0 : 1.0) * kPerCell * cells;
      if (setup.numerics.water_bulk_modulus > 1e6) radius -= kPerWater;
      radius += 100.0 * kOfC1 * parameters.C_1();
      if (topples && time >= 10.0 && parameters.C_1() > tests::seed_mud().C_1()) radius += kTopples;
      mpm::Outline outline{time, {}};
      for (int i = 0; i <= 40; ++i) outline.points.push_back({radius, 0.04 * i / 40.0});
      result.outlines.push_back(std::move(outline));
    }
    return result;
  };
}

datasets::Study two_lifts() {
  datasets::Study study{.file = {},
                        .material = tests::seed_mud(),
                        .fit = {},
                        .oedometer_tests = {},
                        .slump_tests = {},
                        .assumptions = {}};
  for (const double speed : {0.06, 0.01, 0.06}) {
    datasets::SlumpTest test{};
    test.name = "slump-" + std::to_string(study.slump_tests.size() + 1);
    test.setup.mould.lift_speed = speed;
    test.setup.numerics.cell_size = kRadius / 6.0;
    test.setup.numerics.points_per_cell = 9;
    test.setup.times = {1.0, 10.0};
    test.hold_out = study.slump_tests.size() == 2;
    study.slump_tests.push_back(std::move(test));
  }
  return study;
}

SimulationError measured(bool topples) {
  auto error = measure_simulation_error(two_lifts(), tests::seed_mud(), cylinders(topples), 1);
  EXPECT_TRUE(error.has_value());
  return *error;
}

// Cells: one more, two more, none more (the points are nine already), and the water: squares of 1, 4 and 0,
// and of its own over four.
TEST(SimulationErrorOfTests, IsTheirOwnAndThatOfAllAsOneVariantMore) {
  const SimulationError error = measured(false);
  const double cells = 5.0 * kPerCell * kPerCell;
  const double water = kPerWater * kPerWater;
  const double fast = (cells + water) / 4.0;
  const double slow = (9.0 * cells + water) / 4.0;
  const double all = 0.5 * (fast + slow);
  // the slow mould has left the mud by the second outline only
  const double gone = std::sqrt((2.0 * fast + slow) / 3.0);
  EXPECT_NEAR(error.error.outline, gone, 1e-3 * gone);
  EXPECT_NEAR(error.error.lifting, std::sqrt(slow), 1e-3 * std::sqrt(slow));
  ASSERT_EQ(error.of_tests.size(), 3U);
  const auto expected = [&](double own) {
    const double test = (4.0 * own + all) / 5.0;
    return std::sqrt(5.0 / 3.0 * (4.0 * own + test) / 5.0);  // Student's, of five
  };
  for (const double size : error.of(0).sizes) EXPECT_NEAR(size, expected(fast), 1e-2 * expected(fast));
  for (const double size : error.of(1).sizes) EXPECT_NEAR(size, expected(slow), 1e-2 * expected(slow));
  EXPECT_TRUE(error.of(2).sizes.empty()) << "held out: that of all";
  EXPECT_EQ(error.of(2).outline, error.error.outline);
}

// One of two constants has it topple to one side: half a jump, over the root of two. What C_1 does to first
// order is none.
TEST(SimulationErrorOfTests, GrowsWhereALittleOfTheMaterialDecides) {
  const SimulationError calm = measured(false);
  const SimulationError error = measured(true);
  for (std::size_t test : {0U, 1U}) {
    ASSERT_EQ(error.of(test).sizes.size(), 2U);
    EXPECT_DOUBLE_EQ(error.of(test).sizes[0], calm.of(test).sizes[0]) << "before it topples";
    const double bent = 0.5 * kTopples / std::sqrt(2.0);
    EXPECT_NEAR(error.of(test).sizes[1], std::hypot(calm.of(test).sizes[1], bent), 1e-2 * bent);
  }
  EXPECT_DOUBLE_EQ(error.error.outline, calm.error.outline) << "which is what numerics do";
}

}  // namespace
}  // namespace isotach::calibration
