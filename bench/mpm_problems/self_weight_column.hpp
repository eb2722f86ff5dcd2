// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A column at rest under its own weight.
#pragma once

#include "bench/mpm_problems/elastic_body.hpp"
#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// How the column comes to rest.
enum class ColumnStart {
  unstrained,     ///< it is loaded at once and settles
  in_equilibrium  ///< exact places, strains and stresses are given
};

/// Roots of mean squares over mass, stresses over rho g H, displacements over the largest exact one.
struct ColumnErrors {
  double stress = 0.0;  ///< axial, of points, with their own pressure
  double acting_stress =
      0.0;  ///< axial, of points, with the pressure that acts: averaged over cells, or their own
  double cell_stress = 0.0;  ///< axial, that acts, of the mean of a cell's points
  double displacement = 0.0;
  double velocity = 0.0;  ///< what is left, over g H/c
  double crossed = 0.0;   ///< part of the points that is outside of the cell it started in
};

/// H = 1 m, confined across, on a rough base; `strain` = rho g H/M. The nominal axial stress is
/// -rho0 g (H - Z), the stretch, since the material is linear in ln J, exp(-rho0 g (H - Z)/M). Velocities are
/// damped until they have fallen to 1e-8, by a viscosity of its own; `numerics.viscosity` has no say.
[[nodiscard]] ColumnErrors self_weight_column(int cells, double strain, ColumnStart start,
                                              const Numerics& numerics);

[[nodiscard]] Section self_weight_column_section();

}  // namespace isotach::bench
