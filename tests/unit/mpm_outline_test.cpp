// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines: their measures in closed form, and tracing bodies of known shape.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mpm/outline.hpp"
#include "mpm/particles.hpp"

namespace isotach::mpm {
namespace {

using std::numbers::pi;

constexpr double kCell = 0.004;  // m

TEST(Outline, MeasuresOfACone) {
  const Outline cone{0.0, {{0.05, 0.0}, {0.0, 0.03}}};
  EXPECT_DOUBLE_EQ(cone.height(), 0.03);
  EXPECT_DOUBLE_EQ(cone.toe(), 0.05);
  EXPECT_NEAR(cone.volume(), pi * 0.05 * 0.05 * 0.03 / 3.0, 1e-18);
}

TEST(Outline, MeasuresOfACylinder) {
  const Outline cylinder{0.0, {{0.04, 0.0}, {0.04, 0.1}, {0.0, 0.1}}};
  EXPECT_DOUBLE_EQ(cylinder.height(), 0.1);
  EXPECT_DOUBLE_EQ(cylinder.toe(), 0.04);
  EXPECT_NEAR(cylinder.volume(), pi * 0.04 * 0.04 * 0.1, 1e-18);
}

TEST(Outline, OverhangIsCountedOnce) {
  // a frustum of radii 1 and 2 standing on its small end, height 3: 7 pi
  const Outline frustum{0.0, {{1.0, 0.0}, {2.0, 3.0}, {0.0, 3.0}}};
  EXPECT_NEAR(frustum.volume(), 7.0 * pi, 1e-13);
  EXPECT_DOUBLE_EQ(frustum.toe(), 2.0);
}

void add_point(Particles& particles, double r, double z, double area) {
  particles.r.push_back(r);
  particles.z.push_back(z);
  particles.solid_volume.push_back(0.25 * r * area);  // e = 3
  particles.void_ratio.push_back(3.0);
  ++particles.count;
}

/// 2 by 2 points a cell wherever inside(r, z), within a box of the given size.
template <class Inside>
Particles body(double width, double height, Inside&& inside) {
  Particles particles;
  const double spacing = 0.5 * kCell;
  for (double z = 0.5 * spacing; z < height; z += spacing) {
    for (double r = 0.5 * spacing; r < width; r += spacing) {
      if (inside(r, z)) add_point(particles, r, z, spacing * spacing);
    }
  }
  return particles;
}

Particles block(double radius, double height) {
  return body(radius, height, [](double, double) { return true; });
}

class TracedBlock : public testing::TestWithParam<double> {};

// the block's size in cells, whole and not
INSTANTIATE_TEST_SUITE_P(Sizes, TracedBlock, testing::Values(10.0, 10.5));

TEST_P(TracedBlock, HasAFlatTopAndAPlumbSideWhereTheMudEnds) {
  const double radius = GetParam() * kCell;
  const double height = 2.0 * GetParam() * kCell;
  const Outline outline = trace_outline(block(radius, height), kCell, 1.5);
  EXPECT_EQ(outline.time, 1.5);
  int top = 0;
  int side = 0;
  for (const OutlinePoint& point : outline.points) {
    if (point.r < radius - 2.0 * kCell) {
      EXPECT_NEAR(point.z, height, 0.1 * kCell) << "r = " << point.r / kCell << " cells";
      ++top;
    }
    if (point.z < height - 2.0 * kCell) {
      EXPECT_NEAR(point.r, radius, 0.1 * kCell) << "z = " << point.z / kCell << " cells";
      ++side;
    }
  }
  EXPECT_GE(top, 8);
  EXPECT_GE(side, 18);
  EXPECT_NEAR(outline.volume() / (pi * radius * radius * height), 1.0, 0.015);
}

TEST_P(TracedBlock, RunsFromTheBaseToTheAxisInOrder) {
  const Outline outline = trace_outline(block(GetParam() * kCell, 20.0 * kCell), kCell, 0.0);
  ASSERT_GE(outline.points.size(), 3U);
  EXPECT_NEAR(outline.points.front().z, 0.0, 1e-15);
  EXPECT_NEAR(outline.points.back().r, 0.0, 1e-15);
  for (std::size_t i = 1; i < outline.points.size(); ++i) {
    const auto& a = outline.points[i - 1];
    const auto& b = outline.points[i];
    EXPECT_LE(std::hypot(b.r - a.r, b.z - a.z), kCell) << "a gap after point " << i - 1;
    EXPECT_LE(b.r, a.r + 0.02 * kCell);
    EXPECT_GE(b.z, a.z - 0.02 * kCell);
  }
}

TEST(TracedHeap, HemisphereHasItsRadiusAndVolume) {
  const double radius = 15.0 * kCell;
  const Particles heap =
      body(radius, radius, [&](double r, double z) { return r * r + z * z < radius * radius; });
  const Outline outline = trace_outline(heap, kCell, 0.0);
  for (const OutlinePoint& point : outline.points) {
    EXPECT_NEAR(std::hypot(point.r, point.z), radius, 0.3 * kCell);  // points sit in steps of half a cell
  }
  EXPECT_NEAR(outline.volume() / (2.0 / 3.0 * pi * std::pow(radius, 3)), 1.0, 0.02);
}

TEST(TracedHeap, LumpThatHasComeLooseIsNotTheToe) {
  Particles particles = block(10.0 * kCell, 10.0 * kCell);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 4; ++j) {
      add_point(particles, (15.25 + 0.5 * i) * kCell, (0.25 + 0.5 * j) * kCell, 0.25 * kCell * kCell);
    }
  }
  EXPECT_NEAR(trace_outline(particles, kCell, 0.0).toe(), 10.0 * kCell, 0.1 * kCell);
}

TEST(TracedHeap, SingleSplashedPointIsNoSurface) {
  Particles particles = block(10.0 * kCell, 10.0 * kCell);
  add_point(particles, 5.0 * kCell, 14.0 * kCell, 0.25 * kCell * kCell);
  EXPECT_NEAR(trace_outline(particles, kCell, 0.0).height(), 10.0 * kCell, 0.1 * kCell);
}

}  // namespace
}  // namespace isotach::mpm
