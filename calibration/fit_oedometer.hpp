// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The fit of a study's oedometer tests, and everything that tells how far it can be trusted.
#pragma once

#include <functional>

#include "calibration/bootstrap.hpp"
#include "calibration/fit_result.hpp"
#include "calibration/multi_start.hpp"
#include "calibration/noise_fit.hpp"
#include "calibration/oedometer_start.hpp"
#include "calibration/profile.hpp"
#include "calibration/robustness.hpp"
#include "calibration/stage_checks.hpp"
#include "datasets/study.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::calibration {

/// The two integrators at the answer.
struct IntegratorCheck {
  std::string test;
  double largest_over_noise = 0.0;  ///< largest difference of the two predictions in units of noise
  double at_time = 0.0;             ///< s, where
  std::string failure;              ///< why there is none; empty where there is
};

/// What is learnt about an answer once it is found.
struct OedometerAssessment {
  MultiStart multi_start;
  std::vector<OptimiserResult> global_searches;
  std::vector<Profile> profiles;    ///< of each coordinate
  std::vector<Refit> without_test;  ///< leave-one-test-out
  std::vector<Refit> shifted_inputs;
  std::vector<IntegratorCheck> integrators;
  std::optional<Bootstrap> bootstrap;  ///< where the study asks for one
};

struct OedometerFit {
  FitResult result;
  OedometerExperiments experiments;         ///< all tests of the study
  std::vector<std::vector<double>> locals;  ///< of each experiment, at the answer
  effects::Values<double> effects;          ///< those that are on, at the answer
  Evaluation evaluation;                    ///< of all, at the answer, by the noise that the study states
  double reference_rate = 0.0;              ///< axial strain rate of the gauge (1/s); 0 where none was needed
  std::optional<StartValues> start;         ///< constructions on the data, where the fit started from them
  std::vector<double> first_guess;          ///< coordinates that the first search set out from
  Eigen::MatrixXd white_covariance;         ///< of the coordinates, were the weighted residuals independent
  NoiseFit noise;                           ///< estimated, as the final fit was weighted
  std::vector<TestCheck> checks;            ///< of all tests
  std::optional<OedometerAssessment> assessment;
};

/// How much is worked out.
enum class Depth {
  answer,     ///< parameters, noise and covariance
  assessment  ///< all of OedometerAssessment too
};

struct OedometerFitOptions {
  int threads = 1;
  Depth depth = Depth::assessment;
  bool start_from_data = true;  ///< where the study wants it
  OptimiserControl control;
  /// Fraction of the work done, and what is being done; may be empty.
  std::function<void(double, const std::string&)> progress;
  /// Where a model is a little wrong, its misfit is slow, and beside white scatter it looks like a part that
  /// lasts: whitened by that, the curve as a whole goes where it likes (mud-a with I_v given misses its
  /// relaxation). So a fit asks for an autoregression alone, and only who compares models, each by the noise
  /// of the best, for the sum.
  NoiseParts noise = NoiseParts::lasting;
};

/// The effects that a fit's predictions have, and those of their parameters that it moves.
struct FittedEffects {
  effects::Values<double> on;              ///< with the values that the fit starts from
  std::vector<datasets::FreeEffect> free;  ///< of effects that are on
};

/// Fits `wanted` from `start` to the tests that are not held out: with Ceres, by the noise that the study
/// states; then twice more with residuals whitened by the noise that is estimated from them. `effects` take
/// the place of the study's own.
[[nodiscard]] tl::expected<OedometerFit, FitFailure> fit_oedometer(
    const datasets::Study& study, const model::Parameters<double>& start,
    const std::vector<model::ParameterId>& wanted, const FittedEffects& effects,
    const OedometerFitOptions& options);

/// The same with the study's effects.
[[nodiscard]] tl::expected<OedometerFit, FitFailure> fit_oedometer(
    const datasets::Study& study, const model::Parameters<double>& start,
    const std::vector<model::ParameterId>& wanted, const OedometerFitOptions& options);

/// Works out the rest of fit.assessment, whose multi-start is known, and what follows from it for verdicts,
/// warnings and the check by NLopt.
[[nodiscard]] std::optional<FitFailure> assess(const datasets::Study& study,
                                               const CoordinateSettings& settings, const Problem& problem,
                                               const std::vector<model::ParameterId>& wanted,
                                               const OedometerFitOptions& options, OedometerFit& fit);

}  // namespace isotach::calibration
