// Copyright Isotach contributors. SPDX-License-Identifier: Apache-2.0
// The fit of a study's slump tests by MPM simulations.
#pragma once

#include "calibration/fit_result.hpp"
#include "datasets/study.hpp"
#include "experiments/slump_experiment.hpp"

namespace isotach::calibration {

/// A slump test at the answer.
struct SlumpComparison {
  std::shared_ptr<const experiments::SlumpExperiment> experiment;
  mpm::SlumpResult simulation;
  experiments::Values distances;  ///< m, signed, at each measured point
  double rms = 0.0;               ///< m, all times
  double rms_mould_gone = 0.0;    ///< m, times from which the rim had left the mud; NaN if there is none
};

struct SlumpFit {
  FitResult result;
  std::vector<SlumpComparison> comparisons;  ///< all tests of the study
  double rms_mould_gone = 0.0;               ///< m, over all tests, held-out ones included
  int simulations = 0;
};

struct SlumpFitOptions {
  int threads = 1;
  int max_evaluations = 40;
  double first_step = 0.2;       ///< of logarithmic coordinates
  double first_step_C_1 = 0.08;
  bool uncertainty = true;       ///< costs 2 evaluations a coordinate and the comparison of all tests
  OptimiserControl control;
};

/// Fits the study's [fit] slump parameters from `start` to the tests that are not held out, with NLopt; tests
/// of one evaluation run in parallel.
[[nodiscard]] tl::expected<SlumpFit, FitFailure> fit_slump(const datasets::Study& study,
                                                           const model::Parameters<double>& start,
                                                           const SlumpFitOptions& options);

}  // namespace isotach::calibration
