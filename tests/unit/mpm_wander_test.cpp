// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Slots of a slump that wander: nothing where the change is zero, the constant itself where it stays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpm/slump.hpp"
#include "mpm/wander.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::mpm {
namespace {

/// A quick slump: coarse cells, one second.
SlumpSetup small_slump() {
  SlumpSetup setup;
  setup.mould.fill_height = 0.07;
  setup.mud.void_ratio = 3.6;
  setup.numerics.cell_size = 0.0098;
  setup.times = {0.3, 1.0};
  return setup;
}

SlumpResult run(const SlumpSetup& setup, const model::Parameters<double>& mud = tests::seed_mud()) {
  auto result = run_slump(mud, setup);
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return std::move(*result);
}

/// Largest difference of height or toe (m).
double apart(const SlumpResult& a, const SlumpResult& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.outlines.size(); ++k) {
    most = std::max({most, std::abs(a.outlines[k].height() - b.outlines[k].height()),
                     std::abs(a.outlines[k].toe() - b.outlines[k].toe())});
  }
  return most;
}

Wander constant(WanderSlot slot, double change) {
  return {slot, {-1.0, 0.5}, {change, change}};
}

TEST(Wander, IsAPolygonThatStaysBeyondItsEnds) {
  const Wander wander{WanderSlot::base_in_time, {0.0, 1.0, 3.0}, {2.0, -1.0, 5.0}};
  EXPECT_EQ(wander(-7.0), 2.0);
  EXPECT_EQ(wander(0.0), 2.0);
  EXPECT_DOUBLE_EQ(wander(0.5), 0.5);
  EXPECT_DOUBLE_EQ(wander(1.0), -1.0);
  EXPECT_DOUBLE_EQ(wander(2.5), 3.5);
  EXPECT_EQ(wander(3.0), 5.0);
  EXPECT_EQ(wander(9.0), 5.0);
  EXPECT_DOUBLE_EQ(wander.in_time(WanderSlot::base_in_time, std::exp(0.5)), 0.5);
  EXPECT_EQ(wander.in_time(WanderSlot::base_in_time, 0.0), 2.0) << "before the first knot, at the start";
  EXPECT_EQ(wander.in_time(WanderSlot::wall_in_time, 1.0), 0.0);
}

TEST(Wander, OfAWallThatStaysIsItsAdhesion) {
  SlumpSetup wandering = small_slump();
  wandering.wander = constant(WanderSlot::wall_in_time, 40.0);
  SlumpSetup sticky = small_slump();
  sticky.mould.wall.adhesion = 40.0;
  EXPECT_EQ(apart(run(wandering), run(sticky)), 0.0);
  EXPECT_GT(apart(run(sticky), run(small_slump())), 1e-5);
}

TEST(Wander, OfABaseThatStaysIsItsSlipLength) {
  SlumpSetup wandering = small_slump();
  wandering.wander = constant(WanderSlot::base_in_time, 2e-3);
  SlumpSetup sliding = small_slump();
  sliding.base.friction.slip_length = 2e-3;
  EXPECT_EQ(apart(run(wandering), run(sliding)), 0.0);
  EXPECT_GT(apart(run(sliding), run(small_slump())), 1e-5);
}

TEST(Wander, OfTheBaseActsWhenItsTimeHasCome) {
  SlumpSetup late = small_slump();
  late.wander = {WanderSlot::base_in_time, {std::log(0.3), std::log(0.31)}, {0.0, 2e-3}};
  const SlumpResult with = run(late);
  const SlumpResult without = run(small_slump());
  EXPECT_EQ(with.outlines.front().toe(), without.outlines.front().toe());
  EXPECT_GT(std::abs(with.outlines.back().toe() - without.outlines.back().toe()), 1e-6);
}

// p_B(e) times exp(c) is that of mud with 1 + e100 larger by exp(lambda c).
class StrengthThatStays : public testing::TestWithParam<WanderSlot> {};
TEST_P(StrengthThatStays, IsALargerE100) {
  constexpr double kChange = 0.2;
  SlumpSetup wandering = small_slump();
  wandering.wander = constant(GetParam(), kChange);
  const auto mud = tests::seed_mud();
  auto values = mud.values();
  values[model::ParameterId::e100] = (1.0 + mud.e100()) * std::exp(mud.lambda() * kChange) - 1.0;
  const SlumpResult stronger = run(small_slump(), *model::Parameters<double>::create(values));
  const double effect = apart(stronger, run(small_slump()));
  EXPECT_GT(effect, 1e-4);
  EXPECT_LT(apart(stronger, run(wandering)), 0.02 * effect);
}
INSTANTIATE_TEST_SUITE_P(All, StrengthThatStays,
                         testing::Values(WanderSlot::strength_in_time, WanderSlot::strength_in_height,
                                         WanderSlot::strength_in_rate));

// Mud that is stronger above than below keeps a higher top than mud that is stronger below.
TEST(Wander, OfStrengthOverHeightStaysWithTheMud) {
  SlumpSetup top = small_slump();
  top.wander = {WanderSlot::strength_in_height, {0.0, 1.0}, {-0.3, 0.3}};
  SlumpSetup bottom = small_slump();
  bottom.wander = {WanderSlot::strength_in_height, {0.0, 1.0}, {0.3, -0.3}};
  EXPECT_GT(run(top).outlines.back().toe(), run(bottom).outlines.back().toe());
}

}  // namespace
}  // namespace isotach::mpm
