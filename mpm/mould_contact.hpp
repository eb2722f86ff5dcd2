// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The lifted mould as tractions on the material points that touch it.
#pragma once

#include "mpm/point_force.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::mpm {

/// Force of the wall on a point (N/rad); it acts on the point's outer edge, at R.
struct WallForce {
  double r = 0.0;
  double z = 0.0;
};

/// A point as the wall meets it.
struct WallPoint {
  double r, z;                    ///< m
  double velocity_r, velocity_z;  ///< at the wall (m/s)
  double mass;                    ///< kg/rad
  double radial_pressure;         ///< total (Pa), compression positive
};

/// The mould: a cylinder r = R above its rim, acting on the mud inside.
///
/// A point stands for a square of mud of size `point_size`. It touches the wall where its outer edge passes
/// R; the wall answers with a stiff normal traction over the height of the square. Where the rim has passed
/// part of the square, the wall can carry no more than its share of the mud's radial pressure, so support
/// ends gradually as the rim rises past a point and not before or after by the size of a cell. The wall is a
/// force on points, not a condition on grid nodes: where it acts does not depend on how nodes lie to R and
/// to the rim. Shear on the wall takes away part of the slip, up to its limit.
///
/// The wall has no thickness. A point with its centre beyond R has left below the rim: where it rises again
/// beside the wall, the outer face, which is smooth, holds it out by no more than the mud's radial pressure.
class MouldContact final : public PointForce {
 public:
  struct Constants {
    double point_size;        ///< m
    double normal_stiffness;  ///< Pa/m: traction for a depth of penetration
    /// Pa s/m: traction for a velocity of penetration, so that the wall does not ring.
    double normal_damping;
    /// m: mud inside is pressed into the wall so far at most. From there on, up to twice as far, the wall
    /// answers less and less firmly, down to the mud's own radial pressure.
    double firm_depth;
    /// Weight of the mud (N/m3): the wall carries the pressure of the filled mould without being pushed.
    double unit_weight = 0.0;
  };
  /// The mould of a setup, its wall as it is at each time.
  MouldContact(const SlumpSetup& setup, const Constants& constants)
      : setup_(setup),
        radius_(0.5 * setup.mould.diameter),
        half_size_(0.5 * constants.point_size),
        constants_(constants) {}

  void add(const ForceBlock& block) const override;

  /// Force of a wall on a point when the rim is at `rim` (m), moving at `rim_velocity` (m/s), in a step of dt
  /// (s).
  [[nodiscard]] WallForce force(const WallPoint& point, const Wall& wall, double rim, double rim_velocity,
                                double dt) const;

 private:
  /// Traction (Pa) outwards on a point beside the wall, up to `pressure` (Pa).
  [[nodiscard]] double outer_traction(const WallPoint& point, double pressure) const;
  /// How far the wall must be pushed for the pressure in the filled mould at a height (m).
  template <class T>
  [[nodiscard]] T preload(const T& z) const {
    return (constants_.unit_weight / constants_.normal_stiffness) * (setup_.mould.fill_height - z);
  }

  SlumpSetup setup_;
  double radius_;
  double half_size_;
  Constants constants_;
};

}  // namespace isotach::mpm
