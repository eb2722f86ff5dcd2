// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The seed's test 1 against finer cells and shorter steps: what docs/mpm-verification.md says of both.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/mpm_problems/vhp_slump.hpp"

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

TEST(SlumpConvergence, HalvedStepsMoveTheSlumpAfterThirtySecondsByLessThanATenthOfAMillimetre) {
  mpm::SlumpSetup setup = seed_test_1(4 * kMillimetre, {0.5, 1.0, 5.0, 15.0, 30.0});
  const mpm::SlumpResult whole = run_seed_mud(setup);
  setup.numerics.courant *= 0.5;
  const mpm::SlumpResult half = run_seed_mud(setup);
  ASSERT_GT(static_cast<double>(half.steps), 1.8 * static_cast<double>(whole.steps));
  EXPECT_NEAR(half.outlines.back().height(), whole.outlines.back().height(), 0.1 * kMillimetre);
  EXPECT_NEAR(half.outlines.back().toe(), whole.outlines.back().toe(), 0.1 * kMillimetre);
  // creep by itself, without the fast part before it: height lost and ground gained from 5 s on
  const auto fall = [](const mpm::SlumpResult& run) {
    return run.outlines[2].height() - run.outlines[4].height();
  };
  const auto spread = [](const mpm::SlumpResult& run) {
    return run.outlines[4].toe() - run.outlines[2].toe();
  };
  EXPECT_GT(fall(whole), 0.2 * kMillimetre);
  EXPECT_NEAR(fall(half), fall(whole), 0.03 * kMillimetre);
  EXPECT_NEAR(spread(half), spread(whole), 0.03 * kMillimetre);
}

}  // namespace
}  // namespace isotach::bench
