// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Elastic bodies whose motion is known: they are followed on the MPM engine and compared with it.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mpm/engine.hpp"

namespace isotach::bench {

struct ElasticConstants {
  double young = 1e6;       ///< Pa
  double poisson = 0.3;     ///< -
  double density = 1000.0;  ///< kg/m3

  [[nodiscard]] double shear() const { return young / (2.0 * (1.0 + poisson)); }  ///< mu (Pa)
  [[nodiscard]] double lame() const {                                             ///< lambda (Pa)
    return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  }
  [[nodiscard]] double bulk() const { return lame() + 2.0 / 3.0 * shear(); }    ///< K (Pa)
  [[nodiscard]] double wave_modulus() const { return lame() + 2.0 * shear(); }  ///< M = K + 4/3 G (Pa)
  [[nodiscard]] double wave_speed() const { return std::sqrt(wave_modulus() / density); }  ///< m/s
};

/// What may be chosen without changing the problem.
struct Numerics {
  bool averaged = false;        ///< tr D and mean stress over cells
  double residual_time = 0.15;  ///< s, as EngineSettings
  double viscosity = 0.0;       ///< alpha: the artificial viscosity is alpha rho c h
  double courant = 0.4;         ///< of c and the cell; the step is the same throughout
  int points = 2;               ///< in a cell, along each side
};

inline constexpr double kNeverFades = std::numeric_limits<double>::infinity();

/// Of components r and z (plane: x and y).
struct Pair {
  double r = 0.0;
  double z = 0.0;
};
/// A field over the body as it was at the start, and time (s).
using Field = std::function<Pair(Pair place, double time)>;

/// A body that fills [0, width] x [0, height] at the start, at rest in shape, and its exact motion.
struct ElasticProblem {
  mpm::Symmetry symmetry = mpm::Symmetry::axisymmetric;
  mpm::Sides sides;
  double width = 1.0;       ///< m; whole spacings of points
  double height = 1.0;      ///< m; whole spacings of points
  double open_right = 0.0;  ///< cells of the grid beyond the body
  ElasticConstants material;
  Field displacement;       ///< m; zero at time 0
  Field velocity;           ///< m/s
  Field force;              ///< N/kg; none where it is empty
  Field traction;           ///< Pa, nominal, on the side r = width; none where it is empty
  double shape_time = 0.0;  ///< s; amplitudes are multiples of the displacement at this time
};

struct MotionErrors {
  double velocity = 0.0;      ///< root of the mean square over mass and time, over that of the exact one
  double displacement = 0.0;  ///< the same
  double crossed = 0.0;       ///< largest part of the points that was outside of the cell it started in
  std::vector<double> times;  ///< s, after each step
  std::vector<double>
      amplitudes;  ///< of the displacement's projection on its exact shape, 1 = exact at shape_time
};

/// Runs the problem with cells of `cell` m for `duration` s. The engine's velocities stand between its
/// places in time (half a step before them), so they start and are compared there.
[[nodiscard]] MotionErrors follow(const ElasticProblem& problem, double cell, double duration,
                                  const Numerics& numerics);

/// Points of a box [0, width] x [0, height] of elastic material at rest. omega[0] and omega[1] keep the
/// places at the start: the engine reorders points.
[[nodiscard]] mpm::Body elastic_box(double width, double height, double cell, mpm::Symmetry symmetry,
                                    const ElasticConstants& material, const Numerics& numerics);

/// Place of point i at the start.
[[nodiscard]] inline Pair start_of(const mpm::Particles& q, std::size_t i) {
  return {q.omega[0][i], q.omega[1][i]};
}

/// Angular frequency (rad/s) of the sinusoid that is closest to the values, near a first guess.
[[nodiscard]] double fitted_frequency(const std::vector<double>& times, const std::vector<double>& values,
                                      double guess);

/// How the numerics are called in the report: "points", "averaged" for what is averaged over cells.
[[nodiscard]] std::string named(const Numerics& numerics);

}  // namespace isotach::bench
