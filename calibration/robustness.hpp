// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How an oedometer fit's answer depends on what was put in: on each test, and on inputs that were assumed.
#pragma once

#include <string>
#include <vector>

#include "calibration/fit_result.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::calibration {

using OedometerExperiments = std::vector<std::shared_ptr<const experiments::OedometerExperiment>>;

/// Parameters of a fit made otherwise.
struct Refit {
  std::string what;                                     ///< "without crs-2", "phi_c + 2 deg"
  std::optional<model::Parameters<double>> parameters;  ///< nothing where it failed
  std::string failure;
  std::vector<double> shift;    ///< of each coordinate, in standard errors of the fit
  double rms_over_noise = 0.0;  ///< of the test left out, or of all fitted ones together
};

/// What a refit starts from.
struct RefitBase {
  const CoordinateSettings& settings;
  const OedometerExperiments& experiments;  ///< all of the study
  const Problem& problem;
  const std::vector<double>& answer;
  const std::vector<ExperimentWeights>& weights;
  const Uncertainty& uncertainty;
  const std::vector<model::ParameterId>& wanted;
  int threads;
  const OptimiserControl& control;
};

/// The fit without each of its tests in turn, which is then predicted; none where only one is fitted.
[[nodiscard]] std::vector<Refit> leave_one_out(const RefitBase& base);

/// The fit with phi_c +-2 deg, K0 at the start +-0.1 and G_s +-0.05, as far as these are inputs and not
/// fitted.
[[nodiscard]] std::vector<Refit> shift_inputs(const RefitBase& base);

}  // namespace isotach::calibration
