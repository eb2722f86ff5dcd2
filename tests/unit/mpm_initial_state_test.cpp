// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The state the mud starts from: by hand from the formulas of the seed's Table 4 mud.
#include <gtest/gtest.h>

#include "mpm/slump.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::mpm {
namespace {

using tests::seed_mud;

// sin(14.2 deg) = 0.2453074; M = 6 sin/(3 - sin) = 0.5343044
// p_B(3.891) = 100 kPa (4.891/2.358)^(-1/0.154) = 876.0066 Pa
TEST(InitialState, OfAGivenVoidRatio) {
  Mud mud;
  mud.void_ratio = 3.891;
  const InitialState state = initial_state(seed_mud(), mud);
  EXPECT_DOUBLE_EQ(state.void_ratio, 3.891);
  EXPECT_NEAR(state.preconsolidation_pressure, 876.0066, 1e-4);
  EXPECT_NEAR(state.mean_effective_pressure, 584.0044, 1e-4);  // OCR0 1.5
  EXPECT_NEAR(state.density, 1337.3543, 1e-4);                 // 1000 (2.65 + 3.891)/4.891
}

// C_u = M p_B/4 [|D| (1 - 0.03)/6.8e-7]^0.02: the bracket is 0.97 at |D| = D_r and 14264.7 at 0.01 /s
TEST(InitialState, StrengthGrowsWithRateToThePowerIv) {
  Mud mud;
  mud.void_ratio = 3.891;
  EXPECT_NEAR(initial_state(seed_mud(), mud).undrained_strength, 116.94228, 1e-5);
  EXPECT_DOUBLE_EQ(initial_state(seed_mud(), mud).strength_rate, 6.8e-7);
  mud.strength_rate = 0.01;
  EXPECT_NEAR(initial_state(seed_mud(), mud).undrained_strength, 141.68419, 1e-4);
}

// The mud of the test above, however its strength was measured. Between 1e-4 and 1 /s the strength grows by
// 1e4^I_v = 1.2022644.
TEST(InitialState, StrengthAtAnyRateFollowsFromTheVoidRatioAlone) {
  Mud mud;
  mud.void_ratio = 3.891;
  for (const double measured_at : {6.8e-7, 1.0}) {
    mud.strength_rate = measured_at;
    const InitialState state = initial_state(seed_mud(), mud);
    EXPECT_NEAR(critical_state_strength(seed_mud(), state, 0.01), 141.68419, 1e-4);
    EXPECT_NEAR(
        critical_state_strength(seed_mud(), state, 1.0) / critical_state_strength(seed_mud(), state, 1e-4),
        1.2022644, 1e-6);
  }
}

// 117 Pa at 0.01 /s: p_B = 117 Pa/(M/4 14264.7^0.02), e = 2.358 (p_B/100 kPa)^-0.154 - 1
TEST(InitialState, VoidRatioIsSolvedFromTheStrength) {
  EXPECT_NEAR(void_ratio_from_strength(seed_mud(), 117.0, 0.01), 4.0373315, 1e-6);
  Mud mud;
  mud.undrained_strength = 117.0;
  mud.strength_rate = 0.01;
  const InitialState state = initial_state(seed_mud(), mud);
  EXPECT_NEAR(state.void_ratio, 4.0373315, 1e-6);
  EXPECT_NEAR(state.undrained_strength, 117.0, 1e-9);
  EXPECT_DOUBLE_EQ(state.strength_rate, 0.01);
}

TEST(InitialState, GivenVoidRatioGoesBeforeStrength) {
  Mud mud;
  mud.void_ratio = 3.0;
  mud.undrained_strength = 117.0;
  EXPECT_DOUBLE_EQ(initial_state(seed_mud(), mud).void_ratio, 3.0);
}

}  // namespace
}  // namespace isotach::mpm
