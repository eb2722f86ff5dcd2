// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/elastic_bar.hpp"

#include <fmt/format.h>

#include <numbers>

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

BarErrors elastic_bar(int cells, const Numerics& numerics) {
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

}  // namespace isotach::bench
