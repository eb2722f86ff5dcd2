// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where an oedometer test and its prediction part: residuals by stage, their order and their correlation.
#pragma once

#include <string>
#include <vector>

#include "calibration/noise_fit.hpp"
#include "calibration/residual_tests.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::calibration {

/// Residuals of one stage of a test.
struct StageCheck {
  std::string stage;   ///< "load", "unload", "relax", "hold", with its number where it comes again
  double from_time;    ///< s
  double to_time;      ///< s
  double from_stress;  ///< Pa, measured
  double to_stress;    ///< Pa
  std::size_t count;
  double rms_over_noise;   ///< by the noise that the study states
  double mean_over_noise;  ///< the model's above the measured
  /// Probability of so large a sum of squares from independent noise of the stated size.
  double p_value;
  bool misfit;  ///< more than noise: see kStageMisfit
};

/// A stage counts as missed where its rms is above this times the noise, and noise alone would do that once
/// in a thousand.
inline constexpr double kStageMisfit = 1.3;

struct TestCheck {
  std::string name;
  bool held_out;
  std::vector<StageCheck> stages;
  RunsTest runs;           ///< of the residuals as they are
  LjungBox ljung_box;      ///< of the same
  LjungBox whitened;       ///< of the residuals freed of the estimated noise; of a fitted test only
  double autocorrelation;  ///< lag-1, as they are
  bool patterned;          ///< runs or Ljung-Box say, at 1 in a thousand, that they are no independent noise
};

/// Checks of one test: `scaled` residuals in units of the stated noise, `white` the whitened ones (empty for
/// a test that was not fitted).
[[nodiscard]] TestCheck check_test(const experiments::OedometerExperiment& experiment,
                                   const experiments::Values& scaled, const experiments::Values& white);

}  // namespace isotach::calibration
