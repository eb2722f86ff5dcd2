// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The lifted mould as tractions on the material points that touch it.
#pragma once

#include <algorithm>

#include "mpm/slump_setup.hpp"

namespace isotach::mpm {

/// Force of the wall on a point (N/rad).
struct WallForce {
  double r = 0.0;
  double z = 0.0;
};

/// The mould: a cylinder r = R above its rim z_w(t) = lift speed times t, acting on the mud inside.
///
/// A point stands for a square of mud of size `point_size`. It touches the wall where its outer edge passes
/// R; the wall answers with a stiff normal traction over the height of the square. Where the rim has passed
/// part of the square, the wall can carry no more than its share of the mud's radial pressure, so support
/// ends gradually as the rim rises past a point and not before or after by the size of a cell. The wall is a
/// force on points, not a condition on grid nodes: where it acts does not depend on how nodes lie to R and
/// z_w.
class MouldContact {
 public:
  /// `normal_stiffness` in Pa/m: traction for a depth of penetration; `normal_damping` in Pa s/m: traction
  /// for a velocity of penetration, so that the wall does not ring.
  MouldContact(const Mould& mould, double point_size, double normal_stiffness, double normal_damping)
      : radius_(0.5 * mould.diameter),
        lift_speed_(mould.lift_speed),
        rough_(mould.wall == Wall::rough),
        half_size_(0.5 * point_size),
        normal_stiffness_(normal_stiffness),
        normal_damping_(normal_damping) {}

  /// Height of the rim (m) at time t (s).
  [[nodiscard]] double rim(double t) const { return lift_speed_ * t; }

  /// Force on a point at (r, z) with its velocity (m/s), mass (kg/rad) and radial total pressure
  /// (Pa, compression positive) when the rim is at `rim` (m) and the step is `dt` (s). `initial_pressure`
  /// (Pa) is the point's total pressure in the filled mould: the wall carries it from the start, without
  /// first being pushed.
  [[nodiscard]] WallForce force(double r, double z, double velocity_r, double velocity_z, double mass,
                                double radial_pressure, double initial_pressure, double rim,
                                double dt) const {
    const double depth = r + half_size_ - radius_ + initial_pressure / normal_stiffness_;
    const double covered = z + half_size_ - rim;
    // beyond 2 half sizes the point has left through the gap below the rim and stands outside
    if (depth <= 0.0 || covered <= 0.0 || depth > 2.0 * half_size_) return {};
    const double share = std::min(1.0, covered / (2.0 * half_size_));
    double traction = std::max(0.0, normal_stiffness_ * depth + normal_damping_ * velocity_r);
    if (share < 1.0) traction = std::min(traction, share * std::max(radial_pressure, 0.0));
    WallForce f;
    f.r = -traction * radius_ * 2.0 * half_size_;
    if (rough_) f.z = share * kStick * mass * (lift_speed_ - velocity_z) / dt;
    return f;
  }

 private:
  // Part of the slip velocity that a rough wall takes away in a step: below 1 for stability with neighbours
  // that share nodes, and gone within a few steps.
  static constexpr double kStick = 0.25;

  double radius_;
  double lift_speed_;
  bool rough_;
  double half_size_;
  double normal_stiffness_;
  double normal_damping_;
};

}  // namespace isotach::mpm
