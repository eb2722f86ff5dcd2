// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/outline_noise.hpp"

#include <cmath>
#include <numbers>

namespace isotach::bench {

experiments::Values draw_errors(const experiments::SlumpExperiment& test, const OutlineNoise& noise,
                                std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  constexpr int kWaves = 4;
  double kept[kWaves];
  for (double& amplitude : kept) amplitude = normal(random);
  experiments::Values errors(test.outline_index().size());
  std::size_t outline = std::size_t(-1);
  double waves[kWaves] = {};
  for (const experiments::OutlineStation& station : test.stations()) {
    if (station.outline != outline) {
      outline = station.outline;
      for (int w = 0; w < kWaves; ++w) waves[w] = (kept[w] + normal(random)) / std::numbers::sqrt2;
    }
    double shared = waves[0];
    for (int w = 1; w < kWaves; ++w) {
      shared += std::numbers::sqrt2 * waves[w] * std::cos(w * std::numbers::pi * station.place);
    }
    shared *= noise.shared / std::sqrt(double(kWaves));
    for (const std::size_t i : station.points) errors[i] = shared + noise.reading * normal(random);
  }
  return errors;
}

}  // namespace isotach::bench
