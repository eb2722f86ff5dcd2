// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Quadratic B-spline weights: the moments that make transfers exact for linear fields.
#include <gtest/gtest.h>

#include <limits>

#include "mpm/spline.hpp"

namespace isotach::mpm {
namespace {

constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();

// 0.5 (a point on the axis) to 3.5 in steps that meet cell centres, faces and places between.
constexpr int kPositions = 121;
double position(int k) {
  return 0.5 + 0.025 * k;
}

TEST(SplineWeights, AreNonNegativeAndSumToOne) {
  for (int k = 0; k < kPositions; ++k) {
    const SplineWeights s = spline_weights(position(k));
    double sum = 0.0;
    for (const double weight : s.weight) {
      EXPECT_GE(weight, 0.0);
      sum += weight;
    }
    EXPECT_NEAR(sum, 1.0, kRounding) << "at " << position(k);
  }
}

TEST(SplineWeights, FirstMomentIsZeroAndSecondAQuarter) {
  for (int k = 0; k < kPositions; ++k) {
    const SplineWeights s = spline_weights(position(k));
    double first = 0.0;
    double second = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      first += s.weight[a] * s.offset[a];
      second += s.weight[a] * s.offset[a] * s.offset[a];
    }
    EXPECT_NEAR(first, 0.0, kRounding) << "at " << position(k);
    EXPECT_NEAR(second, 0.25, kRounding) << "at " << position(k);
  }
}

TEST(SplineWeights, OffsetsLeadFromThePointToItsNodes) {
  for (int k = 0; k < kPositions; ++k) {
    const SplineWeights s = spline_weights(position(k));
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(position(k) + s.offset[a], s.base + static_cast<double>(a), kRounding * 4.0);
    }
  }
}

// A node's weight is the spline 3/4 - x^2 within half a cell and (3/2 - |x|)^2/2 beyond: 3/4 at the node, 1/2
// half a cell away, 1/8 a cell away.
TEST(SplineWeights, TakeTheSplinesValuesAtANodeAndBetweenTwo) {
  const SplineWeights at_node = spline_weights(2.0);
  EXPECT_EQ(at_node.base, 1);
  EXPECT_DOUBLE_EQ(at_node.weight[0], 0.125);
  EXPECT_DOUBLE_EQ(at_node.weight[1], 0.75);
  EXPECT_DOUBLE_EQ(at_node.weight[2], 0.125);
  const SplineWeights between = spline_weights(2.5);
  EXPECT_EQ(between.base, 2);
  EXPECT_DOUBLE_EQ(between.weight[0], 0.5);
  EXPECT_DOUBLE_EQ(between.weight[1], 0.5);
  EXPECT_DOUBLE_EQ(between.weight[2], 0.0);
}

}  // namespace
}  // namespace isotach::mpm
