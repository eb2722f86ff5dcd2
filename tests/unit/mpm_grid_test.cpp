// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The mirrored grid: what points give to nodes and get back next to the axis, the base and other sides.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mpm/grid.hpp"

namespace isotach::mpm {
namespace {

constexpr double kCell = 0.004;  // m
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A point with an affine velocity.
struct Point {
  double r, z, mass;
  double v_r, v_z;
  double c_rr, c_rz, c_zr, c_zz;
};

/// Velocity and its gradient as a point reads them off the grid.
struct Reading {
  double v_r, v_z, dr_dr, dr_dz, dz_dr, dz_dz;
};

double spline(double x) {
  x = std::abs(x);
  if (x < 0.5) return 0.75 - x * x;
  return x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0.0;
}

/// f(node, weight, place of the node less (r, z)) for all nodes that a point touches.
template <class F>
void for_each_node(const Grid& grid, double r, double z, F&& f) {
  for (std::size_t j = 0; j < grid.rows() + 2; ++j) {
    for (std::size_t i = 0; i < grid.columns() + 2; ++i) {
      const double dr = (static_cast<double>(i) - 0.5) * kCell - r;
      const double dz = (static_cast<double>(j) - 0.5) * kCell - z;
      const double weight = spline(dr / kCell) * spline(dz / kCell);
      if (weight > 0.0) f(grid.index(i, j), weight, dr, dz);
    }
  }
}

Grid empty_grid(const Sides& sides = {Side::symmetric, Side::open, Side::fixed, Side::open}) {
  Grid grid(kCell, 10 * kCell, 10 * kCell, sides);
  for (std::size_t j = 0; j < grid.rows() + 2; ++j) grid.sums().touch(j, grid.stride());
  return grid;
}

void fold(Grid& grid) {
  grid.fold_columns();
  grid.fold_rows();
}

void give(Grid& grid, const Point& p) {
  for_each_node(grid, p.r, p.z, [&](std::size_t n, double weight, double dr, double dz) {
    const double m = weight * p.mass;
    Octet& node = grid.sums().data()[n];
    node[kMass] += m;
    node[kMomentumR] += m * (p.v_r + p.c_rr * dr + p.c_rz * dz);
    node[kMomentumZ] += m * (p.v_z + p.c_zr * dr + p.c_zz * dz);
  });
}

/// f(i, j) for the nodes that are no images in axis or base.
template <class F>
void for_each_original(const Grid& grid, F&& f) {
  for (std::size_t j = 1; j < grid.rows() + 2; ++j) {
    for (std::size_t i = 1; i < grid.columns() + 2; ++i) f(i, j);
  }
}

void divide_by_mass(Grid& grid) {
  for_each_original(grid, [&](std::size_t i, std::size_t j) {
    const std::size_t n = grid.index(i, j);
    const Octet& node = grid.sums().data()[n];
    const double inverse = node[kMass] > 0.0 ? 1.0 / node[kMass] : 0.0;
    grid.velocities()[n] = NodeVelocity{node[kMomentumR] * inverse, node[kMomentumZ] * inverse, 0.0, 0.0};
  });
  grid.mirror_velocities();
}

Reading read(const Grid& grid, double r, double z) {
  Reading out{};
  const double gradient = 4.0 / (grid.cell_size() * grid.cell_size());
  for_each_node(grid, r, z, [&](std::size_t n, double weight, double dr, double dz) {
    const NodeVelocity& v = grid.velocities()[n];
    out.v_r += weight * v[0];
    out.v_z += weight * v[1];
    out.dr_dr += gradient * weight * dr * v[0];
    out.dr_dz += gradient * weight * dz * v[0];
    out.dz_dr += gradient * weight * dr * v[1];
    out.dz_dz += gradient * weight * dz * v[1];
  });
  return out;
}

/// A block of 5 by 5 cells in the corner of axis and base, 2 by 2 points a cell, moving as v_r = a r,
/// v_z = -2 a z.
std::vector<Point> stretching_block(double a) {
  std::vector<Point> points;
  for (int l = 0; l < 10; ++l) {
    for (int k = 0; k < 10; ++k) {
      const double r = (k + 0.5) * 0.5 * kCell;
      const double z = (l + 0.5) * 0.5 * kCell;
      points.push_back({r, z, r, a * r, -2.0 * a * z, a, 0.0, 0.0, -2.0 * a});
    }
  }
  return points;
}

TEST(GridMirrors, KeepAllMassOnTheOriginals) {
  Grid grid = empty_grid();
  std::mt19937 random(20240611);
  std::uniform_real_distribution<double> place(1e-4 * kCell, 3.0 * kCell);
  double total = 0.0;
  constexpr int kPoints = 200;
  for (int i = 0; i < kPoints; ++i) {
    const double mass = 1.0 + place(random);
    give(grid, {place(random), place(random), mass, 0, 0, 0, 0, 0, 0});
    total += mass;
  }
  fold(grid);
  double found = 0.0;
  for_each_original(
      grid, [&](std::size_t i, std::size_t j) { found += grid.sums().data()[grid.index(i, j)][kMass]; });
  EXPECT_NEAR(found, total, kPoints * kEpsilon * total);
}

// A point at (0.2, 0.3) cells gives its nodes the weights (0.32, 0.66, 0.02) in r and (0.245, 0.71, 0.045) in
// z, by hand. Node (1, 1) and its three images then hold: mass all with +; r components with - across the
// axis and - across the base; z components with + across the axis and - across the base.
TEST(GridMirrors, FoldWithTheParityOfEachComponent) {
  Grid grid = empty_grid();
  for_each_node(grid, 0.2 * kCell, 0.3 * kCell, [&](std::size_t n, double weight, double, double) {
    grid.sums().data()[n] += Octet{} + weight;
  });
  fold(grid);
  const Octet& node = grid.sums().data()[grid.index(1, 1)];
  const double even_even = (0.66 + 0.32) * (0.71 + 0.245);
  const double odd_odd = (0.66 - 0.32) * (0.71 - 0.245);
  const double even_odd = (0.66 + 0.32) * (0.71 - 0.245);
  constexpr double kRounding = 16.0 * kEpsilon;
  EXPECT_NEAR(node[kMass], even_even, kRounding);
  for (const std::size_t entry : {kMomentumR, kInternalR, kAppliedR}) {
    EXPECT_NEAR(node[entry], odd_odd, kRounding) << "entry " << entry;
  }
  for (const std::size_t entry : {kMomentumZ, kInternalZ, kAppliedZ}) {
    EXPECT_NEAR(node[entry], even_odd, kRounding) << "entry " << entry;
  }
}

// v_r odd in r and v_z even there, both odd in z: v_r = A r z and v_z = -2 C z obey the mirrors, are
// bilinear, and so come back exactly, with their gradients, from the first point off axis and base on.
TEST(GridMirrors, BilinearFieldOfTheirParityIsReadExactly) {
  Grid grid = empty_grid();
  constexpr double kA = 700.0;  // 1/(m s)
  constexpr double kC = 3.0;    // 1/s
  for_each_original(grid, [&](std::size_t i, std::size_t j) {
    const double r = (static_cast<double>(i) - 0.5) * kCell;
    const double z = (static_cast<double>(j) - 0.5) * kCell;
    grid.velocities()[grid.index(i, j)] = NodeVelocity{kA * r * z, -2.0 * kC * z, 0.0, 0.0};
  });
  grid.mirror_velocities();
  for (const double x : {0.001, 0.25, 0.5, 0.75, 1.0, 1.3, 2.9}) {
    for (const double y : {0.001, 0.25, 0.5, 0.75, 1.0, 1.3, 2.9}) {
      const double r = x * kCell;
      const double z = y * kCell;
      const Reading got = read(grid, r, z);
      constexpr double kSpeed = 1e-13;  // m/s, speeds are up to 0.1
      constexpr double kRate = 1e-11;   // 1/s, gradients up to 8
      EXPECT_NEAR(got.v_r, kA * r * z, kSpeed);
      EXPECT_NEAR(got.v_z, -2.0 * kC * z, kSpeed);
      EXPECT_NEAR(got.dr_dr, kA * z, kRate);
      EXPECT_NEAR(got.dr_dz, kA * r, kRate);
      EXPECT_NEAR(got.dz_dr, 0.0, kRate);
      EXPECT_NEAR(got.dz_dz, -2.0 * kC, kRate);
    }
  }
}

// Points of one affine field give it to every node they reach, whatever their masses. The base takes part for
// v_z only: there v_r = a r slips, which the base does not allow, so v_r is looked at two cells above it.
TEST(GridMirrors, AffineMotionSurvivesTheWayToTheGridAndBack) {
  constexpr double kStretch = 2.5;  // 1/s
  Grid grid = empty_grid();
  const std::vector<Point> block = stretching_block(kStretch);
  for (const Point& point : block) give(grid, point);
  fold(grid);
  divide_by_mass(grid);
  constexpr double kSpeed = 1e-14;
  constexpr double kRate = 1e-11;
  int off_base = 0;
  for (const Point& point : block) {
    const Reading got = read(grid, point.r, point.z);
    EXPECT_NEAR(got.v_z, point.v_z, kSpeed);
    EXPECT_NEAR(got.dz_dz, -2.0 * kStretch, kRate);
    EXPECT_NEAR(got.dz_dr, 0.0, kRate);
    if (point.z < 2.0 * kCell) continue;
    ++off_base;
    EXPECT_NEAR(got.v_r, point.v_r, kSpeed) << "r = " << point.r / kCell << " cells";
    EXPECT_NEAR(got.dr_dr, kStretch, kRate) << "r = " << point.r / kCell << " cells";
    // incompressible at every point, also at the first off the axis
    EXPECT_NEAR(got.dr_dr + got.dz_dz + got.v_r / point.r, 0.0, kRate);
  }
  EXPECT_EQ(off_base, 60);
}

TEST(GridMirrors, BaseHoldsAndAxisLetsNothingAcross) {
  constexpr double kStretch = 2.5;
  Grid grid = empty_grid();
  for (const Point& point : stretching_block(kStretch)) give(grid, point);
  fold(grid);
  divide_by_mass(grid);
  for (const double s : {0.3, 1.1, 2.7}) {
    const Reading on_axis = read(grid, 0.0, s * kCell);
    EXPECT_NEAR(on_axis.v_r, 0.0, 1e-16);
    const Reading on_base = read(grid, s * kCell, 0.0);
    EXPECT_NEAR(on_base.v_r, 0.0, 1e-16);
    EXPECT_NEAR(on_base.v_z, 0.0, 1e-16);
  }
}

// A wall on the right that is smooth, a lid that holds: the parities of axis and base, mirrored.
TEST(GridMirrors, HoldAtTheFarSidesToo) {
  Grid grid = empty_grid({Side::open, Side::symmetric, Side::open, Side::fixed});
  const double width = grid.width();
  const double height = grid.height();
  for (const double s : {0.4, 0.5, 0.6}) {
    give(grid, {width - s * kCell, height - 0.5 * kCell, 1.0, 0.3, -0.2, 0.0, 0.0, 0.0, 0.0});
  }
  fold(grid);
  for (std::size_t j = 1; j <= grid.rows(); ++j) {
    for (std::size_t i = 1; i <= grid.columns(); ++i) {
      const Octet& node = grid.sums().data()[grid.index(i, j)];
      const double mass = std::max(node[kMass], 1e-300);
      grid.velocities()[grid.index(i, j)] =
          NodeVelocity{node[kMomentumR] / mass, node[kMomentumZ] / mass, 0.0, 0.0};
    }
  }
  grid.mirror_velocities();
  const Reading at_wall = read(grid, width, height - kCell);
  EXPECT_NEAR(at_wall.v_r, 0.0, 1e-16);
  EXPECT_LT(at_wall.v_z, -1e-3) << "the wall is smooth";
  const Reading at_lid = read(grid, width - 0.5 * kCell, height);
  EXPECT_NEAR(at_lid.v_r, 0.0, 1e-16);
  EXPECT_NEAR(at_lid.v_z, 0.0, 1e-16);
}

}  // namespace
}  // namespace isotach::mpm
