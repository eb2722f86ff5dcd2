// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/breathing_cylinder.hpp"

#include <fmt/format.h>

#include <numbers>

namespace isotach::bench {

double breathing_wave_number(double poisson) {
  const double ratio = (1.0 - 2.0 * poisson) / (1.0 - poisson);
  const auto left = [ratio](double x) {
    return x * std::cyl_bessel_j(0.0, x) - ratio * std::cyl_bessel_j(1.0, x);
  };
  // left() falls from above zero (ratio < 2, since nu > 0) to below it before the first zero of J0
  double low = 0.1;
  double high = 2.404;
  if (poisson == 0.0) low = 1.0;
  while (high - low > 1e-14) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (left(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

BreathingErrors breathing_cylinder(int cells, const Numerics& numerics, const ElasticConstants& material) {
  constexpr double kAmplitude = 1e-6;
  ElasticProblem problem;
  problem.material = material;
  problem.sides = {mpm::Side::symmetric, mpm::Side::open, mpm::Side::symmetric, mpm::Side::symmetric};
  problem.open_right = 3.0;
  const double cell = problem.width / cells;
  problem.height = 2.0 * cell;
  const double k = breathing_wave_number(material.poisson);
  const double w = k * material.wave_speed();
  const auto shape = [k](double r) {
    return kAmplitude * std::copysign(std::cyl_bessel_j(1.0, k * std::abs(r)), r);
  };
  problem.displacement = [=](Pair x, double t) { return Pair{shape(x.r) * std::sin(w * t), 0.0}; };
  problem.velocity = [=](Pair x, double t) { return Pair{shape(x.r) * w * std::cos(w * t), 0.0}; };
  const double period = 2.0 * std::numbers::pi / w;
  problem.shape_time = 0.25 * period;
  BreathingErrors errors;
  errors.motion = follow(problem, cell, period, numerics);
  const MotionErrors longer = follow(problem, cell, 3.0 * period, numerics);
  errors.frequency = fitted_frequency(longer.times, longer.amplitudes, w) / w - 1.0;
  return errors;
}

}  // namespace isotach::bench
