// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Motion along a base that yields to shear.
#pragma once

#include <vector>

#include "mpm/base_friction.hpp"
#include "mpm/grid.hpp"
#include "mpm/transfer.hpp"

namespace isotach::mpm {

/// What the forces on nodes do in a step, and the nodes' kinetic energy after it (J/rad, or J/m).
struct NodeWork {
  double internal = 0.0;
  double applied = 0.0;
  double kinetic = 0.0;

  NodeWork& operator+=(const NodeWork& other) {
    internal += other.internal;
    applied += other.applied;
    kinetic += other.kinetic;
    return *this;
  }
};

/// The nodes next to a base that yields. They move along it by themselves, so each step takes them out of the
/// grid before its nodes are advanced, and puts them back.
class SlidingBase {
 public:
  /// As where nothing slides.
  void forget() { slip_.clear(); }
  /// Velocities along the base, before and after a step of dt (s), of nodes whose mass is `inertia` times
  /// what weighs. The columns of the sums must have been folded, and not the rows.
  NodeWork slide(const Grid& grid, const BaseFriction& base, Symmetry symmetry, double dt, double inertia);
  /// Leaves nothing along the base in the sums of what slides.
  void take_out(Grid& grid) const;
  /// Gives the grid the velocities of what slides.
  void put_back(Grid& grid) const;

 private:
  /// Of the nodes above and below (m/s).
  struct Slip {
    bool touches = false;
    double before_below = 0.0;
    double before_above = 0.0;
    double below = 0.0;
    double above = 0.0;
  };

  std::vector<Slip> slip_;  ///< at the columns of nodes; empty where nothing slides
};

}  // namespace isotach::mpm
