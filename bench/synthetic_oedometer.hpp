// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Synthetic oedometer tests of known parameters, made by the reference integrator, for studies and benches.
#pragma once

#include <cstdint>
#include <random>

#include "datasets/study.hpp"

namespace isotach::bench {

enum class Protocol {
  crs_steps,        ///< rates of 1e-6 and 1e-5 /s, unloading and reloading, a relaxation
  crs_single_rate,  ///< one rate, no unloading
  incremental       ///< nine loads of a day, with unloading
};

/// In [0, 1), the same on every platform.
[[nodiscard]] double uniform(std::mt19937_64& random);

/// The seed mud's constants with C_1 0.05, each but phi_c times a factor within +-25 %.
[[nodiscard]] model::Parameters<double> random_parameters(std::mt19937_64& random);

/// The test without noise, from 10 kPa at the steady K0 and an overconsolidation ratio; `density` scales the
/// number of rows, about 240, 200 and 216 at 1. CVODES in six components, relative tolerance 1e-11.
[[nodiscard]] datasets::OedometerTest exact_test(Protocol protocol, const model::Parameters<double>& truth,
                                                 double ocr, double density = 1.0);

/// Standard deviation of strain readings of an incremental test that goes with `level`.
[[nodiscard]] constexpr double strain_noise(double level) {
  return 0.02 * level;
}

/// Adds noise of `level` relative to stress, or of strain_noise(level) to strain where the test is
/// incremental, with first-order autocorrelation rho from row to row.
void add_noise(datasets::OedometerTest& test, double level, double rho, std::mt19937_64& random);

}  // namespace isotach::bench
