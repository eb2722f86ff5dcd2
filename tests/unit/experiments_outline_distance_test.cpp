// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// signed_distance: sides, corners and ends of an outline, against distances measured by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "experiments/outline_distance.hpp"

namespace isotach::experiments {
namespace {

/// A cylinder of mud, 4 wide and 3 high, from its toe up the side and over the top to the axis.
const std::vector<mpm::OutlinePoint> kCylinder{{4.0, 0.0}, {4.0, 3.0}, {0.0, 3.0}};

TEST(SignedDistance, IsPositiveInsideTheSimulatedMud) {
  EXPECT_DOUBLE_EQ(signed_distance({3.5, 1.0}, kCylinder), 0.5);
  EXPECT_DOUBLE_EQ(signed_distance({1.0, 2.0}, kCylinder), 1.0);
}

TEST(SignedDistance, IsNegativeOutside) {
  EXPECT_DOUBLE_EQ(signed_distance({4.25, 1.0}, kCylinder), -0.25);
  EXPECT_DOUBLE_EQ(signed_distance({1.0, 5.0}, kCylinder), -2.0);
}

TEST(SignedDistance, VanishesOnTheOutline) {
  for (const mpm::OutlinePoint& point : {mpm::OutlinePoint{4.0, 1.5}, {4.0, 3.0}, {0.0, 3.0}, {2.0, 3.0}}) {
    EXPECT_EQ(std::abs(signed_distance(point, kCylinder)), 0.0);
  }
}

TEST(SignedDistance, BeyondAConvexCornerIsTheDistanceToTheCorner) {
  EXPECT_DOUBLE_EQ(signed_distance({7.0, 7.0}, kCylinder), -5.0);  // 3-4-5 triangle from (4, 3)
}

// Near a corner both segments are equally near; taken alone, the far one's line has the point on its other
// side.
TEST(SignedDistance, AtAnAcuteCornerTheSideIsThatOfTheMud) {
  const std::vector<mpm::OutlinePoint> spike{{4.0, 0.0}, {10.0, 1.0}, {0.0, 2.0}};
  EXPECT_DOUBLE_EQ(signed_distance({12.0, 1.0}, spike), -2.0);
  // to the left of the first segment's line drawn on, but outside
  EXPECT_LT(signed_distance({13.0, 2.0}, spike), 0.0);
  EXPECT_NEAR(signed_distance({13.0, 2.0}, spike), -std::sqrt(10.0), 1e-12);
  // to the left of the second segment's line drawn back, but outside
  EXPECT_NEAR(signed_distance({13.0, 0.0}, spike), -std::sqrt(10.0), 1e-12);
}

TEST(SignedDistance, InAConcaveCornerIsTheNearerSide) {
  // a step: toe at 6, a terrace of height 1, a core of radius 2 and height 4
  const std::vector<mpm::OutlinePoint> step{{6.0, 0.0}, {6.0, 1.0}, {2.0, 1.0}, {2.0, 4.0}, {0.0, 4.0}};
  EXPECT_DOUBLE_EQ(signed_distance({3.0, 3.0}, step), -1.0);                              // the core's side
  EXPECT_DOUBLE_EQ(signed_distance({5.0, 1.5}, step), -0.5);                              // the terrace's top
  EXPECT_DOUBLE_EQ(signed_distance({1.4, 0.2}, step), std::sqrt(0.6 * 0.6 + 0.8 * 0.8));  // its inner corner
}

TEST(SignedDistance, BeyondTheEndsIsTheDistanceToTheEnd) {
  EXPECT_DOUBLE_EQ(signed_distance({7.0, -4.0}, kCylinder), -5.0);   // below the toe, outside
  EXPECT_DOUBLE_EQ(signed_distance({1.0, -4.0}, kCylinder), 5.0);    // below the base, inside
  EXPECT_DOUBLE_EQ(signed_distance({-3.0, 7.0}, kCylinder), -5.0);   // across the axis, above the top
  EXPECT_DOUBLE_EQ(signed_distance({-0.75, 2.0}, kCylinder), 1.25);  // across the axis, below it
}

TEST(SignedDistance, ASegmentOfNoLengthChangesNothing) {
  const std::vector<mpm::OutlinePoint> doubled{{4.0, 0.0}, {4.0, 3.0}, {4.0, 3.0}, {0.0, 3.0}, {0.0, 3.0}};
  for (const mpm::OutlinePoint& point : {mpm::OutlinePoint{3.0, 1.0}, {7.0, 7.0}, {1.0, 2.5}, {-3.0, 7.0}}) {
    EXPECT_EQ(signed_distance(point, doubled), signed_distance(point, kCylinder));
  }
}

}  // namespace
}  // namespace isotach::experiments
