// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The wall's force on a material point, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/mould_contact.hpp"

namespace isotach::mpm {
namespace {

constexpr double kRadius = 0.039;          // m
constexpr double kFill = 0.14;             // m
constexpr double kSize = 0.002;            // m
constexpr double kStiffness = 5e7;         // Pa/m
constexpr double kDamping = 4e3;           // Pa s/m
constexpr double kLift = 0.06;             // m/s
constexpr double kMass = 1e-4;             // kg/rad
constexpr double kStep = 1e-4;             // s
constexpr double kArea = kRadius * kSize;  // of the wall a point covers, per radian

MouldContact contact(const Wall& wall, double unit_weight = 0.0) {
  SlumpSetup setup;
  setup.mould = {2.0 * kRadius, kFill, kLift, wall, 0.0, {}};
  return MouldContact(setup, {kSize, kStiffness, kDamping, 0.125 * kSize, unit_weight});
}

/// A point, resting unless said otherwise, with its outer edge `depth` beyond the wall.
struct Point {
  double depth = 0.0;
  double z = 0.05;
  double velocity_r = 0.0;
  double velocity_z = 0.0;
  double pressure = 1000.0;
  double rim = 0.0;
};

WallForce force(const Point& p, const Wall& wall = Wall::smooth(), double unit_weight = 0.0) {
  return contact(wall, unit_weight)
      .force({kRadius - 0.5 * kSize + p.depth, p.z, p.velocity_r, p.velocity_z, kMass, p.pressure}, wall,
             p.rim, kLift, kStep);
}

TEST(Mould, RimRisesAtTheLiftSpeedOnceTheDelayIsOver) {
  Mould mould;
  mould.lift_speed = kLift;
  EXPECT_DOUBLE_EQ(mould.rim(0.0), 0.0);
  EXPECT_DOUBLE_EQ(mould.rim(2.5), 0.15);
  EXPECT_DOUBLE_EQ(mould.rim_velocity(2.5), kLift);
  mould.lift_delay = 0.5;
  EXPECT_DOUBLE_EQ(mould.rim(0.4), 0.0);
  EXPECT_DOUBLE_EQ(mould.rim_velocity(0.4), 0.0);
  EXPECT_DOUBLE_EQ(mould.rim(3.0), 0.15);
}

TEST(Mould, RimFollowsATable) {
  Mould mould;
  mould.lift_table = {{0.5, 0.0}, {1.0, 0.02}, {3.0, 0.1}};
  EXPECT_DOUBLE_EQ(mould.rim(0.2), 0.0);
  EXPECT_DOUBLE_EQ(mould.rim_velocity(0.2), 0.0);
  EXPECT_DOUBLE_EQ(mould.rim(0.75), 0.01);
  EXPECT_DOUBLE_EQ(mould.rim(2.0), 0.06);
  EXPECT_DOUBLE_EQ(mould.rim_velocity(2.0), 0.04);
  EXPECT_DOUBLE_EQ(mould.rim(4.0), 0.14);  // the last speed goes on
  mould.lift_delay = 1.0;
  EXPECT_DOUBLE_EQ(mould.rim(3.0), 0.06);
}

TEST(MouldContact, PointShortOfTheWallFeelsNothing) {
  for (const Wall& wall : {Wall::smooth(), Wall::rough()}) {
    const WallForce f = force({.depth = -1e-6, .velocity_r = 0.1, .velocity_z = -0.1}, wall);
    EXPECT_EQ(f.r, 0.0);
    EXPECT_EQ(f.z, 0.0);
  }
}

TEST(MouldContact, PenetrationIsAnsweredByStiffnessAndDamping) {
  // 1e-5 m at 5e7 Pa/m is 500 Pa; 0.01 m/s at 4e3 Pa s/m is 40 Pa
  EXPECT_NEAR(force({.depth = 1e-5}).r, -500.0 * kArea, 1e-9 * kArea * 500.0);
  EXPECT_NEAR(force({.depth = 1e-5, .velocity_r = 0.01}).r, -540.0 * kArea, 1e-9 * kArea * 540.0);
  EXPECT_NEAR(force({.depth = 1e-5, .velocity_r = -0.01}).r, -460.0 * kArea, 1e-9 * kArea * 460.0);
}

TEST(MouldContact, WallNeverPulls) {
  EXPECT_EQ(force({.depth = 1e-5, .velocity_r = -1.0}).r, 0.0);
  // the rim half way up a point whose radial stress is tension
  EXPECT_EQ(force({.depth = 1e-5, .z = 0.05, .pressure = -300.0, .rim = 0.05}).r, 0.0);
}

TEST(MouldContact, FilledMouldIsCarriedWithoutBeingPushed) {
  // 0.09 m below the surface of 13.5 kN/m3
  EXPECT_NEAR(force({.depth = 0.0, .z = 0.05}, Wall::smooth(), 13500.0).r, -1215.0 * kArea, 1e-9 * kArea);
  EXPECT_EQ(force({.depth = 0.0, .z = 0.15}, Wall::smooth(), 13500.0).r, 0.0);
}

TEST(MouldContact, RimPastPartOfAPointLeavesItsShareOfThePressure) {
  // covered: from the rim up to z + size/2
  EXPECT_NEAR(force({.depth = 1e-4, .z = 0.05, .rim = 0.05}).r, -0.5 * 1000.0 * kArea, 1e-9 * kArea * 1000.0);
  EXPECT_NEAR(force({.depth = 1e-4, .z = 0.05, .rim = 0.0505}).r, -0.25 * 1000.0 * kArea,
              1e-9 * kArea * 1000.0);
  // a lightly pressed wall gives no more than its stiffness: 1e-6 m at 5e7 Pa/m is 50 Pa
  EXPECT_NEAR(force({.depth = 1e-6, .z = 0.05, .rim = 0.05}).r, -50.0 * kArea, 1e-6 * kArea * 50.0);
}

TEST(MouldContact, SupportEndsContinuouslyAsTheRimPasses) {
  const double just_covered = force({.depth = 1e-4, .rim = 0.051 - 1e-9}).r;
  EXPECT_LT(just_covered, 0.0);
  EXPECT_GT(just_covered, -1e-3 * kArea);
  EXPECT_EQ(force({.depth = 1e-4, .rim = 0.051 + 1e-9}).r, 0.0);
}

TEST(MouldContact, PointThatLeftBelowTheRimStandsOutsideFree) {
  for (const Wall& wall : {Wall::smooth(), Wall::rough()}) {
    const WallForce f = force({.depth = 1.1 * kSize, .z = 0.05, .rim = 0.0}, wall);
    EXPECT_EQ(f.r, 0.0);
    EXPECT_EQ(f.z, 0.0);
  }
}

// Mud that left below the rim and rises beside the mould: k depth where it presses, never more than its
// pressure.
TEST(MouldContact, OuterFaceHoldsMudOutByNoMoreThanItsPressure) {
  for (const Wall& wall : {Wall::smooth(), Wall::rough()}) {
    const WallForce light = force({.depth = kSize - 1e-5, .z = 0.05}, wall);
    EXPECT_NEAR(light.r, 500.0 * kArea, 1e-6 * kArea * 500.0);
    EXPECT_EQ(light.z, 0.0);
    EXPECT_NEAR(force({.depth = 0.6 * kSize}, wall).r, 1000.0 * kArea, 1e-9 * kArea * 1000.0);
    EXPECT_EQ(force({.depth = 0.6 * kSize, .pressure = -10.0}, wall).r, 0.0);
    EXPECT_EQ(force({.depth = 0.6 * kSize, .velocity_r = 1e4}, wall).r, 0.0);
  }
}

// A point so deep in the wall as mud inside is never pressed came round the rim.
TEST(MouldContact, PointDeepInTheWallIsNotShotThroughTheMud) {
  const double firm = 0.125 * kSize;
  EXPECT_NEAR(force({.depth = 0.9 * firm}).r, -0.9 * firm * kStiffness * kArea, 1e-9 * kArea * 1e4);
  EXPECT_NEAR(force({.depth = 0.45 * kSize}).r, -1000.0 * kArea, 1e-9 * kArea * 1e3);
  EXPECT_EQ(force({.depth = 0.45 * kSize, .pressure = -10.0}).r, 0.0);
  // without a jump on the way
  double before = force({.depth = 0.0}).r;
  const double step = 1e-3 * kSize;
  for (double depth = step; depth < 0.5 * kSize; depth += step) {
    const double now = force({.depth = depth}).r;
    EXPECT_LE(std::abs(now - before), 1.001 * step * kStiffness * kArea) << "at " << depth;
    before = now;
  }
}

TEST(MouldContact, OnlyARoughWallDragsAndNeverPastItsOwnSpeed) {
  EXPECT_EQ(force({.depth = 1e-5}, Wall::smooth()).z, 0.0);
  const double up = force({.depth = 1e-5, .velocity_z = -0.02}, Wall::rough()).z;
  EXPECT_GT(up, 0.0);
  EXPECT_LT(up * kStep / kMass, kLift + 0.02);
  const double down = force({.depth = 1e-5, .velocity_z = 0.1}, Wall::rough()).z;
  EXPECT_LT(down, 0.0);
  EXPECT_GT(down * kStep / kMass, kLift - 0.1);
  EXPECT_EQ(force({.depth = 1e-5, .velocity_z = kLift}, Wall::rough()).z, 0.0);
}

TEST(MouldContact, DragIsSharedUnderTheRimToo) {
  const Point whole{.depth = 1e-5, .rim = 0.0};
  const Point half{.depth = 1e-5, .rim = 0.05};
  EXPECT_NEAR(force(half, Wall::rough()).z, 0.5 * force(whole, Wall::rough()).z,
              1e-9 * force(whole, Wall::rough()).z);
}

// A limit on shear changes nothing where the wall does not need it, and is what it says where it does.
TEST(MouldContact, ShearIsLimitedByAdhesionAndByFriction) {
  const Point slipping{.depth = 1e-5, .velocity_z = -0.02};  // pressed with 500 Pa
  const double rough = force(slipping, Wall::rough()).z;
  EXPECT_DOUBLE_EQ(force(slipping, {1e6, 0.0}).z, rough);
  EXPECT_NEAR(force(slipping, {30.0, 0.0}).z, 30.0 * kArea, 1e-9 * kArea);
  EXPECT_NEAR(force(slipping, {0.0, 0.1}).z, 50.0 * kArea, 1e-6 * kArea);
  EXPECT_NEAR(force(slipping, {30.0, 0.1}).z, 80.0 * kArea, 1e-6 * kArea);
  const Point falling_back{.depth = 1e-5, .velocity_z = 0.5};
  EXPECT_NEAR(force(falling_back, {30.0, 0.0}).z, -30.0 * kArea, 1e-9 * kArea);
  EXPECT_EQ(force(slipping, {0.0, 0.0}).z, 0.0);
}

}  // namespace
}  // namespace isotach::mpm
