// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A cylinder of yield-stress material that comes to rest under its own weight: slump and spread.
#pragma once

#include <vector>

#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// A cylinder released so slowly that inertia has no say: drag and a little viscosity carry what the yield
/// stress does not.
struct Pile {
  double height = 0.1;          ///< m
  double radius = 0.05;         ///< m
  double yield_stress = 100.0;  ///< tau_y (Pa), in simple shear; von Mises
  bool rough = true;            ///< the base holds the material, or gives way freely
  double cell_size = 0.00625;   ///< m
  double width = 0.2;           ///< m, of the grid
  double duration = 3.0;        ///< s
  double drag = 40.0;           ///< 1/s
  double consistency = 2.0;     ///< Pa s
  double bulk_modulus = 1e5;    ///< Pa
  double shear_modulus = 1e5;   ///< Pa
  bool averaged = true;         ///< dilation and pressure over cells
};

/// The pile in the end, with what tells how far it is at rest and what else went into the answer.
struct PileAtRest {
  double height;           ///< m, of the outline
  double toe;              ///< m, of the outline
  double reach;            ///< m, of the outermost point: where less than half a cell is covered, too
  double kinetic_share;    ///< kinetic over initial potential energy (-)
  double height_rate;      ///< mean of the last tenth of the time (m/s)
  double toe_rate;         ///< likewise (m/s)
  double volume_error;     ///< change of the points' volume over their first (-)
  double fastest_kinetic;  ///< largest kinetic over initial potential energy (-): how slow the release was
  std::vector<double> r;   ///< m, of the outline from the toe to the axis
  std::vector<double> z;   ///< m
  bool failed = false;     ///< a point left the grid; the rest is of that moment
};
[[nodiscard]] PileAtRest settle(const Pile& pile);

/// s/H of a column whose slices spread freely until they carry what is above: 1 - x (1 - ln x), x = sqrt3
/// tau_y/(rho g H), 0 for x >= 1. Pashias, Boger, Summers & Glenister (1996), J. Rheol. 40, 1179, with von
/// Mises' criterion in place of Tresca's (x = 2 tau').
[[nodiscard]] double slump_law(double dimensionless_yield_stress);

/// Radius (m) of a thin deposit on a rough base, (225 rho g V^2/(128 pi^2 tau_c))^(1/5). Roussel & Coussot
/// (2005), J. Rheol. 49, 705.
[[nodiscard]] double spread_law(double density, double volume, double yield_stress);

/// The same (m) at the next order in h/R, by plane flow: h^2 - (pi d + layer) h = 2 d x, d = tau_c/(rho g), x
/// from the edge, so that V = (8 pi/15) sqrt(2 d) R^(5/2) + (pi/2) (pi d + layer) R^2. pi d: stretching above
/// the base carries part of the yield stress. `layer` (m, >= 0): shear takes that height instead of none, and
/// drives half as much in it; where cells resolve the layer it is 0, a grid smears it over about a cell.
[[nodiscard]] double spread_law_with_front(double density, double volume, double yield_stress, double layer);

[[nodiscard]] Section slump_section();
[[nodiscard]] Section spread_section();

inline constexpr double kPileDensity = 1000.0;  ///< kg/m3
inline constexpr double kPileGravity = 9.81;    ///< m/s2

}  // namespace isotach::bench
