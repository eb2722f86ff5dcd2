// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What defines one slump test: mould, mud, base, numerics and the times at which results are wanted.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "mpm/base_friction.hpp"
#include "mpm/elastic_slab.hpp"
#include "mpm/mud_effects.hpp"
#include "mpm/wander.hpp"

namespace isotach::mpm {

/// How the mud meets the inside of the mould: shear traction up to adhesion + friction times normal traction,
/// towards the wall's vertical velocity.
struct Wall {
  double adhesion = 0.0;  ///< Pa, >= 0; infinite: no slip
  double friction = 0.0;  ///< Coulomb's coefficient (-), >= 0

  [[nodiscard]] static Wall smooth() { return {}; }
  [[nodiscard]] static Wall rough() { return {std::numeric_limits<double>::infinity(), 0.0}; }
  [[nodiscard]] bool is_smooth() const { return adhesion == 0.0 && friction == 0.0; }
  [[nodiscard]] bool is_rough() const { return adhesion == std::numeric_limits<double>::infinity(); }
};

/// Height of the mould's rim at a time.
struct RimPlace {
  double time;    ///< s, >= 0
  double height;  ///< m, >= 0
};

/// Cylindrical mould, filled, then raised. SI.
struct Mould {
  double diameter = 0.078;    ///< inner diameter (m), > 0
  double fill_height = 0.14;  ///< height of the mud (m), > 0
  double lift_speed = 0.06;   ///< m/s, > 0
  Wall wall;
  double lift_delay = 0.0;           ///< s, >= 0, before the mould moves
  std::vector<RimPlace> lift_table;  ///< in place of the speed where it is not empty: at least two places,
                                     ///< times increasing, heights not decreasing

  /// Height of the rim (m) at time t (s); the last speed of a table goes on.
  [[nodiscard]] double rim(double t) const;
  /// Its velocity (m/s).
  [[nodiscard]] double rim_velocity(double t) const;
};

/// Initial state of the mud: either the void ratio, or the undrained strength it is solved from.
struct Mud {
  std::optional<double> void_ratio;          ///< e0 (-), > 0
  std::optional<double> undrained_strength;  ///< C_u (Pa), > 0; used where void_ratio is absent
  std::optional<double> strength_rate;       ///< |D| at which C_u was measured (1/s); default D_r
  double specific_gravity = 2.65;            ///< G_s (-), > 1
  double overconsolidation_ratio = 1.5;      ///< OCR0 (-) of the isotropic start, > 0
};

/// What the mud stands on at z = 0: a rigid plane, without slip unless it yields to shear, or an elastic slab
/// that it sticks to.
struct Base {
  BaseFriction friction;  ///< of the rigid plane
  std::optional<ElasticSlab> slab;
};

/// How points and grid exchange motion.
enum class Scheme {
  conserving,  ///< what the grid cannot hold of a point's motion is kept for a while; mud comes down to its
               ///< base
  plain        ///< affine particle-in-cell as in many codes: that motion is lost, and so is energy; mud stays
               ///< above its base by a part of a cell. For comparison with such codes.
};
/// "conserving", "plain".
inline constexpr std::array<std::string_view, 2> kSchemeNames{"conserving", "plain"};

/// Numerical choices; the defaults are meant to be kept.
struct Numerics {
  double cell_size = 0.004;           ///< wanted cell size (m); the one used divides the mould's radius
  int points_per_cell = 4;            ///< material points a cell at the start; 4, 9, 16, ...
  double water_bulk_modulus = 300e3;  ///< K_w (Pa), the undrained penalty
  double courant = 0.8;               ///< fraction of the critical time step, in (0, 1]
  double tolerance = 3e-3;            ///< relative tolerance of the stress update in a step
  double background_viscosity = 0.2;  ///< eta (Pa s) of a stress 2 eta D* beside the law's, >= 0
  int threads = 1;
  double inertia_scaling = 100.0;  ///< largest factor on inertia while the flow is quasi-static; 1 = none
  Scheme scheme = Scheme::conserving;
};

/// One slump test.
struct SlumpSetup {
  Mould mould;
  Mud mud;
  Base base;
  Numerics numerics;
  std::vector<double> times;  ///< output times (s), increasing, > 0; the run ends at the last
  MudEffects effects = {};    ///< of the mud; those of mould and base are theirs
  Wander wander = {};

  /// Of the mould's wall, and of the base, at t (s).
  [[nodiscard]] Wall wall_at(double t) const;
  [[nodiscard]] BaseFriction base_at(double t) const;
};

}  // namespace isotach::mpm
