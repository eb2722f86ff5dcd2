// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/sliding_base.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::mpm {

namespace {

/// Force on the base's point, half on the node below and half on that above, that makes the point's velocity
/// `cells` times what the nodes' velocities, otherwise `below` and `above`, differ by; `ease` is what a force
/// adds to a node's. A base resists and no more: the force is never beyond the one that holds the point, and
/// none where the point is slower than it might be.
double slipping(double below, double above, double ease_below, double ease_above, double cells) {
  const double velocity = 0.5 * (below + above);
  const double holding = -velocity / (0.25 * (ease_below + ease_above));
  // by how much the point is too fast, free and held, in the direction in which it moves
  const double sense = velocity < 0.0 ? -1.0 : 1.0;
  const double too_fast = sense * (velocity - cells * (above - below));
  if (too_fast <= 0.0) return 0.0;
  const double held = -sense * cells * (above - below + 0.5 * holding * (ease_above - ease_below));
  if (held >= 0.0) return holding;
  return holding * too_fast / (too_fast - held);
}

}  // namespace

// Along the base the nodes above and below it (their images) move by themselves, and the base's shear force
// acts on the point between them, half on each; across it nothing moves. A force that holds the base's point
// leaves the nodes above what folding leaves them: the base without slip.
NodeWork SlidingBase::slide(const Grid& grid, const BaseFriction& base, Symmetry symmetry, double dt,
                            double inertia) {
  NodeWork work;
  const double h = grid.cell_size();
  const Octet* nodes = grid.sums().data();
  slip_.assign(grid.stride(), {});
  // the nodes beyond left and right are images
  const std::size_t first = grid.sides().left == Side::open ? 0 : 1;
  const std::size_t last = grid.columns() + (grid.sides().right == Side::open ? 2 : 1);
  for (std::size_t i = first; i < std::min(last, grid.sums().end(0)); ++i) {
    const Octet& below = nodes[grid.index(i, 0)];
    const Octet& above = nodes[grid.index(i, 1)];
    if (below[kMass] <= kLeastNodeMass) continue;  // nothing touches the base here
    Slip& slip = slip_[i];
    slip.touches = true;
    slip.before_below = below[kMomentumR] / below[kMass];
    slip.before_above = above[kMomentumR] / above[kMass];
    const double ease_below = dt / (below[kMass] * inertia);  // velocity for a force
    const double ease_above = dt / (above[kMass] * inertia);
    const double free_below = slip.before_below + ease_below * (below[kInternalR] + below[kAppliedR]);
    const double free_above = slip.before_above + ease_above * (above[kInternalR] + above[kAppliedR]);
    const double ease = 0.25 * (ease_below + ease_above);
    double shear = 0.0;
    if (base.slip_length > 0.0) {
      const double cells = base.slip_length / h;
      shear = slipping(free_below, free_above, ease_below, ease_above, cells);
      // as folding does, the condition is imposed on the velocities before the step too
      const double before = slipping(slip.before_below, slip.before_above, ease_below, ease_above, cells);
      shear -= before;
      slip.before_below += 0.5 * before * ease_below;
      slip.before_above += 0.5 * before * ease_above;
    } else {
      const double r =
          symmetry == Symmetry::axisymmetric ? std::max(0.5 * h, (static_cast<double>(i) - 0.5) * h) : 1.0;
      const double area = std::min(r * h, (below[kVolume] + above[kVolume]) / h);
      const double pressing =
          std::max(0.0, -(below[kInternalZ] + below[kAppliedZ] + above[kInternalZ] + above[kAppliedZ]));
      const double limit = base.adhesion * area + base.friction * pressing;
      const double sticking = -0.5 * (free_below + free_above) / ease;
      if (std::abs(sticking) <= limit) {  // the base without slip
        slip.touches = false;
        continue;
      }
      shear = std::copysign(limit, sticking);
    }
    const double start_below = free_below + (slip.before_below - below[kMomentumR] / below[kMass]);
    const double start_above = free_above + (slip.before_above - above[kMomentumR] / above[kMass]);
    slip.below = start_below + 0.5 * shear * ease_below;
    slip.above = start_above + 0.5 * shear * ease_above;
    const double path_below = 0.5 * (slip.before_below + slip.below) * dt;
    const double path_above = 0.5 * (slip.before_above + slip.above) * dt;
    work.internal += below[kInternalR] * path_below + above[kInternalR] * path_above;
    work.applied += below[kAppliedR] * path_below + above[kAppliedR] * path_above +
                    0.5 * shear * (path_below + path_above);
    work.kinetic += 0.5 * (below[kMass] * slip.below * slip.below + above[kMass] * slip.above * slip.above);
  }
  const auto mirror = [this](std::size_t image, std::size_t original) {
    const Slip& of = slip_[original];
    slip_[image] = {of.touches, -of.before_below, -of.before_above, -of.below, -of.above};
  };
  if (grid.sides().left != Side::open) mirror(0, 1);
  if (grid.sides().right != Side::open) mirror(grid.columns() + 1, grid.columns());
  return work;
}

void SlidingBase::take_out(Grid& grid) const {
  for (std::size_t i = 0; i < std::min(slip_.size(), grid.sums().end(0)); ++i) {
    if (!slip_[i].touches) continue;
    Octet& node = grid.sums().data()[grid.index(i, 1)];
    node[kMomentumR] = node[kInternalR] = node[kAppliedR] = 0.0;
  }
}

void SlidingBase::put_back(Grid& grid) const {
  for (std::size_t i = 0; i < std::min(slip_.size(), grid.sums().end(0)); ++i) {
    const Slip& slip = slip_[i];
    if (!slip.touches) continue;
    NodeVelocity& below = grid.velocities()[grid.index(i, 0)];
    NodeVelocity& above = grid.velocities()[grid.index(i, 1)];
    below = NodeVelocity{slip.below, below[1], slip.before_below, below[3]};
    above = NodeVelocity{slip.above, above[1], slip.before_above, above[3]};
  }
}

}  // namespace isotach::mpm
