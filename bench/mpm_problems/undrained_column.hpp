// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A confined column of undrained mud under its weight and a load on its surface.
#pragma once

#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// Mud of the seed paper (void ratio 3.891, OCR 1.5) between smooth walls, at rest; then a load grows on its
/// surface, carried by points without mass, and stays.
struct MudColumn {
  double height = 0.1;                ///< m
  double cell_size = 0.005;           ///< m; four cells across
  double water_bulk_modulus = 300e3;  ///< K_w (Pa)
  double load = 2000.0;               ///< Pa, total vertical stress
  double loading_time = 0.3;          ///< s
  double holding_time = 0.1;          ///< s
  double jitter = 0.0;                ///< of the points' places at the start, in their spacing (-), < 0.5
  bool averaged = true;               ///< dilation and pressure over cells
};

/// What load and time change, from the first state at rest.
struct ColumnAnswer {
  double pore_pressure_share;  ///< mean rise of the pore pressure over the load (-)
  double skeleton_share;       ///< mean rise of the vertical effective stress, compressive, over the load (-)
  double settlement;           ///< of the surface (m)
};

struct ColumnResult {
  ColumnAnswer answer;        ///< of points deeper than four cells; settlement: their strain over the height
  double surface_settlement;  ///< m, of the points that carry the load
  /// Root mean square, over the load, by which the total pressure of points leaves the straight line in z
  /// that fits those deeper than four cells best: what the points carry, and the average that acts.
  double own_scatter;
  double acting_scatter;
  double surface_own_scatter;  ///< of the upper four cells, from the same line
  double surface_acting_scatter;
  double gradient;  ///< of the acting total pressure in z over -rho g (-): 1 is hydrostatic
  double kinetic;   ///< kinetic energy over load times settlement (-)
};
[[nodiscard]] ColumnResult load_column(const MudColumn& column);

/// The same by the law alone: all depths strain alike, so one element under the vertical total stress of the
/// load, K_w (1+e)/e d + d T_zz/dt (d) = load rate for the rate of compression d, in steps of Runge and
/// Kutta.
[[nodiscard]] ColumnAnswer load_element(const MudColumn& column);

/// Mean stiffness of the water over that of water and skeleton, and the settlement they allow, for the
/// modulus `skeleton` (Pa): load H/(K_w (1+e)/e + skeleton).
[[nodiscard]] ColumnAnswer load_springs(const MudColumn& column, double skeleton);

[[nodiscard]] Section undrained_section();

}  // namespace isotach::bench
