// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/elastic_bar.hpp"

#include <numbers>

#include "bench/mpm_problems/convergence.hpp"

namespace isotach::bench {

namespace {

constexpr double kStrain = 1e-6;
constexpr double kWaveNumber = 0.5 * std::numbers::pi;  // b L

}  // namespace

ElasticProblem elastic_bar_problem(double strain) {
  ElasticProblem problem;
  problem.symmetry = mpm::Symmetry::plane;
  problem.sides = {mpm::Side::symmetric, mpm::Side::open, mpm::Side::symmetric, mpm::Side::symmetric};
  problem.open_right = 3.0;
  const double speed = problem.material.wave_speed();
  const double w = kWaveNumber * speed;
  problem.velocity = [=](Pair x, double t) {
    return Pair{strain * speed * std::sin(kWaveNumber * x.r) * std::cos(w * t), 0.0};
  };
  problem.displacement = [=](Pair x, double t) {
    return Pair{strain * speed / w * std::sin(kWaveNumber * x.r) * std::sin(w * t), 0.0};
  };
  problem.shape_time = 0.5 * std::numbers::pi / w;
  return problem;
}

BarErrors elastic_bar(double cells, const Numerics& numerics) {
  ElasticProblem problem = elastic_bar_problem(kStrain);
  const double cell = problem.width / cells;
  problem.height = 2.0 * cell;
  const double period = 4.0 * problem.shape_time;
  const double frequency = 2.0 * std::numbers::pi / period;
  BarErrors errors;
  errors.motion = follow(problem, cell, period, numerics);
  const MotionErrors longer = follow(problem, cell, 3.0 * period, numerics);
  errors.frequency = fitted_frequency(longer.times, longer.amplitudes, frequency) / frequency - 1.0;
  return errors;
}

Section elastic_bar_section() {
  Section section;
  section.title = "Elastic bar, first mode";
  section.text =
      R"(A bar of 1 m, held across and at its left end, free at its right end, of modulus M = K + 4/3 G:
v = v0 sin(b x) cos(w t), b = pi/(2L), w = b sqrt(M/rho). Strains are 1e-6: no point leaves its cell. 2 x 2 points a cell,
steps of 0.4 h/c, residuals fade in 0.15 s (the engine's default; the period is 0.109 s) and no artificial viscosity,
unless said. Velocities stand half a step before displacements and are started and compared there. Errors are roots of
mean squares over mass and a period, over those of the exact field; the frequency is that of the sinusoid closest to the
modal amplitude of three periods.

The order is 2, averaged over cells or not, with the free end at a side of a cell or in the middle of one, whether what
the grid cannot hold fades in 0.15 s, never, or at once (plain APIC: value and gradient of the grid hand a quadratic
field back unchanged, so what is dropped every step is h^4 times a fourth derivative). Only artificial viscosity, here
0.1 rho c h, costs an order, as it must. The frequency error is that of an endless bar in closed form: the fourth moment of
the quadratic B-spline about points at +-1/4 of their cells, 43/256, takes 0.112 (b h)^2, strains that alternate from
point to point (see the column) stiffen by 0.0044 (b h)^2, the leapfrog gives (0.4 b h)^2/24 back; together
-0.1009 (b h)^2. Averaging doubles the error.)";
  Convergence table({"numerics", "free end"}, {"velocity", "displacement", "frequency"});
  const auto sweep = [&table](const Numerics& numerics, double first, const std::string& end) {
    for (const int factor : {1, 2, 4, 8, 16}) {
      const double cells = 8.0 * factor + (first - 8.0);
      const BarErrors e = elastic_bar(cells, numerics);
      table.add({named(numerics), end}, cells, {e.motion.velocity, e.motion.displacement, e.frequency});
    }
  };
  sweep({}, 8.0, "side of a cell");
  sweep({}, 8.5, "middle of a cell");
  sweep({.averaged = true}, 8.0, "side of a cell");
  sweep({.averaged = true}, 8.5, "middle of a cell");
  sweep({.residual_time = kNeverFades}, 8.0, "side of a cell");
  sweep({.residual_time = 0.0}, 8.0, "side of a cell");
  sweep({.viscosity = 0.1}, 8.0, "side of a cell");
  section.tables.push_back(table.table());
  return section;
}

}  // namespace isotach::bench
