// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The seed's test 1 against finer cells and shorter steps: what docs/mpm-verification.md says of both.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/mpm_problems/vhp_slump.hpp"
#include "model/published_sets.hpp"
#include "mpm/archive.hpp"
#include "mpm/slump_run.hpp"

namespace isotach::bench {
namespace {

constexpr double kMillimetre = 1e-3;

/// Heights and toes of a run are within a share of those of a finer one, at all its times.
void expect_within(const mpm::SlumpResult& coarse, const mpm::SlumpResult& fine, double share) {
  ASSERT_EQ(coarse.outlines.size(), fine.outlines.size());
  for (std::size_t k = 0; k < fine.outlines.size(); ++k) {
    EXPECT_NEAR(coarse.outlines[k].height() / fine.outlines[k].height(), 1.0, share)
        << "height at " << fine.outlines[k].time << " s";
    EXPECT_NEAR(coarse.outlines[k].toe() / fine.outlines[k].toe(), 1.0, share)
        << "toe at " << fine.outlines[k].time << " s";
  }
}

TEST(SlumpConvergence, CellsOfEightMillimetresAreWithinThreePercentOfFineOnesAndOfFourWithinHalfOfThat) {
  const mpm::SlumpResult fine = run_seed_mud(seed_test_1(1.3 * kMillimetre, {1.0, 5.0}));
  ASSERT_GT(fine.points, 12000U);
  expect_within(run_seed_mud(seed_test_1(8 * kMillimetre, {1.0, 5.0})), fine, 0.03);
  expect_within(run_seed_mud(seed_test_1(4 * kMillimetre, {1.0, 5.0})), fine, 0.015);
}

// The wall's stiffness goes with the cells, so what it may be pressed in by must not go with the points.
TEST(SlumpConvergence, SixteenPointsACellSlumpAsNineDo) {
  mpm::SlumpSetup setup = seed_test_1(4 * kMillimetre, {1.0});
  setup.numerics.points_per_cell = 9;
  const mpm::SlumpResult nine = run_seed_mud(setup);
  setup.numerics.points_per_cell = 16;
  const mpm::SlumpResult sixteen = run_seed_mud(setup);
  ASSERT_GT(9 * sixteen.points, 15 * nine.points);
  expect_within(nine, sixteen, 0.015);
}

void run_until(mpm::SlumpRun& run, double time) {
  while (run.time() < time) {
    const auto failure = run.step(time);
    ASSERT_FALSE(failure) << failure->message;
  }
}

// Creep by itself: from one state, 5 s after the start, on with whole and with halved steps.
TEST(SlumpConvergence, HalvedStepsMoveTheCreepingSlumpAtThirtySecondsByLessThanATenthOfAMillimetre) {
  const model::Parameters<double> mud = model::Parameters<double>::create(model::seed_mud_values()).value();
  mpm::SlumpSetup setup = seed_test_1(4 * kMillimetre, {30.0});
  mpm::SlumpRun whole(mud, setup);
  run_until(whole, 5.0);
  mpm::Archive state;
  whole.visit(state);
  const double fallen = whole.outline().height();
  setup.numerics.courant *= 0.5;
  mpm::SlumpRun half(mud, setup);
  mpm::Archive from(state.bytes());
  half.visit(from);
  ASSERT_TRUE(from.complete());
  const long before = whole.steps();
  run_until(whole, 30.0);
  run_until(half, 30.0);
  ASSERT_GT(static_cast<double>(half.steps() - before), 1.8 * static_cast<double>(whole.steps() - before));
  ASSERT_LT(whole.outline().height(), fallen - 0.2 * kMillimetre) << "the mud creeps";
  EXPECT_NEAR(half.outline().height(), whole.outline().height(), 0.1 * kMillimetre);
  EXPECT_NEAR(half.outline().toe(), whole.outline().toe(), 0.1 * kMillimetre);
}

// The fast part before it does depend on the step: by what, docs/mpm-verification.md says. Less than the
// cells do.
TEST(SlumpConvergence, HalvedStepsFromTheStartMoveTheSlumpByLessThanHalfAMillimetre) {
  mpm::SlumpSetup setup = seed_test_1(4 * kMillimetre, {5.0});
  const mpm::SlumpResult whole = run_seed_mud(setup);
  setup.numerics.courant *= 0.5;
  const mpm::SlumpResult half = run_seed_mud(setup);
  ASSERT_GT(static_cast<double>(half.steps), 1.8 * static_cast<double>(whole.steps));
  EXPECT_NEAR(half.outlines.back().height(), whole.outlines.back().height(), 0.5 * kMillimetre);
  EXPECT_NEAR(half.outlines.back().toe(), whole.outlines.back().toe(), 0.5 * kMillimetre);
}

}  // namespace
}  // namespace isotach::bench
