// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The seam for forces that act on points: a wall, a body force.
#pragma once

#include <algorithm>
#include <cstddef>

#include "mpm/grid.hpp"
#include "mpm/particles.hpp"

namespace isotach::mpm {

/// Forces on a block's points, and beside them. Most blocks have none.
class PointLoads {
 public:
  PointLoads(const Grid& grid, NodeSums& sums) : grid_(grid), sums_(sums) {}

  /// Adds a force (N/rad) on the block's point p.
  void add(std::size_t p, double force_r, double force_z) {
    if (!any_) clear_columns();
    force_r_[p] += force_r;
    force_z_[p] += force_z;
  }
  /// Adds a force (N/rad) that acts at a place (m) in the grid, off the points: on the edge of a point's
  /// square, say. It meets the points' stress there, where that ends.
  void add_at(double r, double z, double force_r, double force_z);

  void clear() { any_ = false; }
  [[nodiscard]] bool any() const { return any_; }
  /// Of the block's points, where there are any (N/rad).
  [[nodiscard]] const double* force_r() const { return force_r_; }
  [[nodiscard]] const double* force_z() const { return force_z_; }

 private:
  void clear_columns() {
    std::fill_n(force_r_, kBlock, 0.0);
    std::fill_n(force_z_, kBlock, 0.0);
    any_ = true;
  }

  const Grid& grid_;
  NodeSums& sums_;
  bool any_ = false;
  alignas(64) double force_r_[kBlock];
  alignas(64) double force_z_[kBlock];
};

/// A block of points, the stress that acts in them, and room for the forces on them.
struct ForceBlock {
  const Particles& particles;
  std::size_t begin;
  std::size_t count;
  double time;              ///< s, at the start of the step
  double dt;                ///< s
  const double* stress_rr;  ///< total stress (Pa), tension positive; entry 0 is that of point `begin`
  PointLoads& loads;        ///< of the block's points
};

/// Forces on points. Their work is accounted as that of the boundary.
class PointForce {
 public:
  PointForce() = default;
  PointForce(const PointForce&) = delete;
  PointForce& operator=(const PointForce&) = delete;
  virtual ~PointForce() = default;
  /// Called once a step before the blocks, with all points of the body; may set what they carry beside their
  /// material.
  virtual void prepare(Particles& /*particles*/) {}
  virtual void add(const ForceBlock& block) const = 0;
};

}  // namespace isotach::mpm
