// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The seam for forces that act on points: a wall, a body force.
#pragma once

#include <cstddef>

#include "mpm/particles.hpp"

namespace isotach::mpm {

/// A block of points, the stress that acts in them, and room for the forces on them.
struct ForceBlock {
  const Particles& particles;
  std::size_t begin;
  std::size_t count;
  double time;              ///< s, at the start of the step
  double dt;                ///< s
  const double* stress_rr;  ///< total stress (Pa), tension positive; entry 0 is that of point `begin`
  double* force_r;          ///< N/rad, to be added to
  double* force_z;
};

/// Forces on points. Their work is accounted as that of the boundary.
class PointForce {
 public:
  PointForce() = default;
  PointForce(const PointForce&) = delete;
  PointForce& operator=(const PointForce&) = delete;
  virtual ~PointForce() = default;
  virtual void add(const ForceBlock& block) const = 0;
};

}  // namespace isotach::mpm
