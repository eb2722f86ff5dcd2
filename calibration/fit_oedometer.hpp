// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The fit of a study's oedometer tests.
#pragma once

#include "calibration/fit_result.hpp"
#include "datasets/study.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::calibration {

struct OedometerFit {
  FitResult result;
  std::vector<std::shared_ptr<const experiments::OedometerExperiment>>
      experiments;              ///< all tests of the study
  Evaluation evaluation;        ///< of all, at the answer
  double reference_rate = 0.0;  ///< axial strain rate of the gauge (1/s); 0 where none was needed
};

struct OedometerFitOptions {
  int threads = 1;
  bool check_with_nlopt = true;
  OptimiserControl control;
};

/// Fits `wanted` from `start` to the tests that are not held out, with Ceres, and again with NLopt. The
/// answer reported is Ceres'.
[[nodiscard]] tl::expected<OedometerFit, FitFailure> fit_oedometer(
    const datasets::Study& study, const model::Parameters<double>& start,
    const std::vector<model::ParameterId>& wanted, const OedometerFitOptions& options);

}  // namespace isotach::calibration
