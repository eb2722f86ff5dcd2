// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Volumetric locking: an elastic body in a rough box, bent by a body force into a field without dilation.
#pragma once

#include "bench/mpm_problems/section.hpp"
#include "mpm/transfer.hpp"

namespace isotach::bench {

/// A body that fills 0 < r, z < 1 m and sticks to the box (in axisymmetry: to all but the axis).
struct ClosedBox {
  mpm::Symmetry symmetry = mpm::Symmetry::plane;
  int cells = 8;            ///< along a side
  double bulk_ratio = 1e3;  ///< K/G (-)
  bool averaged = true;     ///< dilation and pressure over cells
};

struct BoxDeflection {
  double amplitude;  ///< projection of the displacement on the exact one, mass-weighted (-): 1 is exact
  double error;      ///< norm of what they differ by, over that of the exact one (-)
  double kinetic;    ///< kinetic energy over the exact elastic energy (-): how far from rest
};

/// The displacement is the curl of psi = f(r) g(z) (plane) or its like in r and z, so its divergence is nil
/// and it solves the elastic problem with the body force -G lap u whatever K is:
///
///   plane:         u_r = -f g',  u_z = f' g,  f = r^2 (1-r)^2,  g = z^2 (1-z)^2, lap psi = f'' g + f g'',
///   axisymmetric:  u_r = -f g'/r, u_z = f' g/r, f = r^2 (1-r^2)^2, E^2 psi = (f'' - f'/r) g + f g'',
///   b_r = G d(lap psi)/dz, b_z = -G d(lap psi)/dr (axisymmetric: over r, E^2 for lap).
///
/// u vanishes on the box. It is scaled to 1e-4 m, so that what is not linear is of relative order 1e-4.
[[nodiscard]] BoxDeflection bend(const ClosedBox& box);

[[nodiscard]] Section locking_section();

}  // namespace isotach::bench
