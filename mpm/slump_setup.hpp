// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What defines one slump test: mould, mud, base, numerics and the times at which results are wanted.
#pragma once

#include <optional>
#include <vector>

namespace isotach::mpm {

/// How the mud meets the inside of the mould.
enum class Wall {
  smooth,  ///< radial confinement only, v_z free
  rough    ///< no slip: the wall's vertical velocity is the mud's
};

/// How the mud meets the base plane z = 0.
enum class BaseKind {
  rough  ///< rigid, no slip
};

/// Cylindrical mould, filled, then raised at constant speed from t = 0. SI.
struct Mould {
  double diameter = 0.078;    ///< inner diameter (m), > 0
  double fill_height = 0.14;  ///< height of the mud (m), > 0
  double lift_speed = 0.06;   ///< m/s, > 0
  Wall wall = Wall::smooth;
};

/// Initial state of the mud: either the void ratio, or the undrained strength it is solved from.
struct Mud {
  std::optional<double> void_ratio;          ///< e0 (-), > 0
  std::optional<double> undrained_strength;  ///< C_u (Pa), > 0; used where void_ratio is absent
  std::optional<double> strength_rate;       ///< |D| at which C_u was measured (1/s); default D_r
  double specific_gravity = 2.65;            ///< G_s (-), > 1
  double overconsolidation_ratio = 1.5;      ///< OCR0 (-) of the isotropic start, > 0
};

struct Base {
  BaseKind kind = BaseKind::rough;
};

/// Numerical choices; the defaults are meant to be kept.
struct Numerics {
  double cell_size = 0.004;           ///< wanted cell size (m); the one used divides the mould's radius
  int points_per_cell = 4;            ///< material points a cell at the start; a square number
  double water_bulk_modulus = 300e3;  ///< K_w (Pa), the undrained penalty
  double courant = 0.8;               ///< fraction of the critical time step, in (0, 1]
  double tolerance = 3e-3;            ///< relative tolerance of the stress update in a step
  double artificial_viscosity =
      0.02;  ///< alpha of eta = alpha rho c h (-), in [0, 0.2]; fades with the cell size
  double inertia_scaling = 100.0;  ///< largest factor on inertia while the flow is quasi-static; 1 = none
};

/// One slump test.
struct SlumpSetup {
  Mould mould;
  Mud mud;
  Base base;
  Numerics numerics;
  std::vector<double> times;  ///< output times (s), increasing, > 0; the run ends at the last
};

}  // namespace isotach::mpm
