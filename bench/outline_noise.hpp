// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Errors of synthetic outlines: each point's own, and smooth ones that an outline shares.
#pragma once

#include <random>

#include "experiments/slump_experiment.hpp"

namespace isotach::bench {

struct OutlineNoise {
  double reading;  ///< m, standard deviation of each point's own error
  double shared;   ///< m, of the waves along an outline, half of each kept through time
};

/// Errors (m) of a test's measured points, outwards. Their covariance is not the one that fits assume.
[[nodiscard]] experiments::Values draw_errors(const experiments::SlumpExperiment& test,
                                              const OutlineNoise& noise, std::mt19937_64& random);

}  // namespace isotach::bench
