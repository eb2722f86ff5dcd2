// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the problems share: rows of points, and a drag that brings motion to rest.
#pragma once

#include "mpm/particles.hpp"
#include "mpm/point_force.hpp"
#include "mpm/transfer.hpp"

namespace isotach::bench {

/// Points in the middles of squares that fill 0 < r < width, 0 < z < height (m), with mass and volume; of
/// `density` (kg/m3), without pores.
[[nodiscard]] mpm::Particles regular_points(double width, double height, double spacing,
                                            mpm::Symmetry symmetry, double density);

/// A force -rate m v on every point. It vanishes with the motion, so a state of rest does not know of it.
class Drag final : public mpm::PointForce {
 public:
  explicit Drag(double rate) : rate_(rate) {}  ///< 1/s, >= 0
  void add(const mpm::ForceBlock& block) const override;

 private:
  double rate_;
};

}  // namespace isotach::bench
