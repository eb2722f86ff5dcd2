// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/fit_oedometer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibration/uncertainty.hpp"

namespace isotach::calibration {

namespace {

tl::expected<GaugeChoice, FitFailure> choose_gauge(const datasets::Study& study,
                                                   const OedometerExperiments& all) {
  GaugeChoice gauge{study.fit.gauge, 0.0};
  if (gauge.kind != datasets::Gauge::crs_rate) return gauge;
  if (study.fit.reference_rate) {
    gauge.reference_rate = *study.fit.reference_rate;
    return gauge;
  }
  for (const auto& experiment : all) {
    if (experiment->held_out()) continue;
    if (const auto rate = experiment->protocol().first_loading_rate) {
      gauge.reference_rate = *rate;
      return gauge;
    }
  }
  return tl::unexpected(
      FitFailure{"no fitted oedometer test has a loading stage to take the gauge's rate from; "
                 "give [fit] reference_rate_per_s"});
}

std::vector<effects::ParameterRef> parameters_of(const std::vector<datasets::FreeEffect>& free) {
  std::vector<effects::ParameterRef> parameters;
  for (const datasets::FreeEffect& one : free) parameters.push_back(one.parameter);
  return parameters;
}

/// The first of the candidates from which the tests can be predicted.
tl::expected<std::vector<double>, FitFailure> first_that_predicts(
    const Problem& problem, const std::vector<std::vector<double>>& candidates) {
  std::string why;
  for (const auto& x : candidates) {
    const auto values = problem.residuals(x);
    if (values) return x;
    why = values.error().message;
  }
  return tl::unexpected(FitFailure{"the start values cannot predict the tests: " + why});
}

/// Ceres, then twice the noise and Ceres again with its weights.
std::optional<FitFailure> find_answer(Problem& problem, const std::vector<double>& start, NoiseParts parts,
                                      const OptimiserControl& control, OedometerFit& fit) {
  const auto minimise = [&](const std::vector<double>& from, double function_tolerance) {
    CeresOptions options;
    options.function_tolerance = function_tolerance;
    OptimiserResult result = minimise_with_ceres(problem, from, options, control);
    fit.result.main.trace.clear();  // costs by other weights cannot be compared
    const int evaluations = fit.result.main.evaluations;
    const int failed = fit.result.main.failed_evaluations;
    fit.result.main = std::move(result);
    fit.result.main.evaluations += evaluations;
    fit.result.main.failed_evaluations += failed;
    return !fit.result.main.interrupted;
  };
  constexpr double kForNoise = 1e-6;  // close enough to see the noise
  constexpr double kForGood = 1e-12;
  if (!minimise(start, kForNoise)) return FitFailure{"interrupted", true};
  for (const double function_tolerance : {kForNoise, kForGood}) {
    auto noise = fit_noise(problem, fit.result.main.coordinates, {parts});
    if (!noise) return FitFailure{"noise: " + noise.error().message};
    fit.noise = std::move(*noise);
    problem.set_weights(fit.noise.weights);
    const std::vector<double> from = fit.result.main.coordinates;
    if (!minimise(from, function_tolerance)) return FitFailure{"interrupted", true};
  }
  return std::nullopt;
}

/// Fits from other starts; where one ends better, that is the answer.
tl::expected<MultiStart, FitFailure> try_other_starts(const datasets::Study& study, Problem& problem,
                                                      const OedometerFitOptions& options, OedometerFit& fit) {
  const std::vector<double> x = fit.result.main.coordinates;
  const auto linearised = problem.linearise(x);
  if (!linearised) return tl::unexpected(FitFailure{linearised.error().message});
  MultiStartOptions starts;
  starts.starts = study.fit.starts - 1;
  starts.seed = study.fit.seed;
  starts.threads = options.threads;
  const OptimiserControl quiet = options.control.quiet();
  MultiStart found =
      multi_start(problem, x, linearised->jacobian.transpose() * linearised->jacobian, starts, quiet);
  if (quiet.stopped()) return tl::unexpected(FitFailure{"interrupted", true});
  if (!found.clusters.empty() && found.clusters.front().cost < fit.result.main.cost - kBetterCost) {
    const Eigen::VectorXd& best = found.clusters.front().best;
    found.moved_the_answer = true;
    problem.set_weights({});
    if (auto failure =
            find_answer(problem, {best.begin(), best.end()}, options.noise, options.control, fit)) {
      return tl::unexpected(*failure);
    }
  }
  return found;
}

/// Residuals of each fitted test, whitened.
std::vector<experiments::Values> whitened(const Problem& problem, const std::vector<double>& x) {
  std::vector<experiments::Values> result;
  const auto residuals = problem.residuals(x);
  Eigen::Index row = 0;
  for (const auto& experiment : problem.fitted()) {
    const auto count = static_cast<Eigen::Index>(experiment->measured().size());
    experiments::Values values;
    if (residuals) values.assign(residuals->data() + row, residuals->data() + row + count);
    result.push_back(std::move(values));
    row += count;
  }
  return result;
}

void check_tests(const Problem& problem, OedometerFit& fit) {
  const auto white = whitened(problem, fit.result.main.coordinates);
  fit.result.adequate = true;
  std::size_t fitted = 0;
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) {
    const bool held_out = fit.experiments[i]->held_out();
    fit.checks.push_back(check_test(*fit.experiments[i], fit.evaluation.scaled_residuals[i],
                                    held_out ? experiments::Values{} : white[fitted]));
    if (held_out) continue;
    ++fitted;
    if (fit.result.tests[i].rms_over_noise > kAdequate) fit.result.adequate = false;
    for (const StageCheck& stage : fit.checks.back().stages) {
      if (stage.misfit) fit.result.adequate = false;
    }
  }
}

}  // namespace

tl::expected<OedometerFit, FitFailure> fit_oedometer(const datasets::Study& study,
                                                     const model::Parameters<double>& start,
                                                     const std::vector<model::ParameterId>& wanted,
                                                     const OedometerFitOptions& options) {
  return fit_oedometer(study, start, wanted, {study.effects, study.fit.oedometer_effects}, options);
}

tl::expected<OedometerFit, FitFailure> fit_oedometer(const datasets::Study& study,
                                                     const model::Parameters<double>& start,
                                                     const std::vector<model::ParameterId>& wanted,
                                                     const FittedEffects& effects,
                                                     const OedometerFitOptions& options) {
  OedometerFit fit;
  Experiments experiments;
  const auto free = parameters_of(effects.free);
  for (const auto& test : study.oedometer_tests) {
    try {
      fit.experiments.push_back(std::make_shared<experiments::OedometerExperiment>(test, effects.on, free));
    } catch (const std::invalid_argument& error) {
      return tl::unexpected(FitFailure{error.what()});
    }
    experiments.push_back(fit.experiments.back());
  }
  const auto gauge = choose_gauge(study, fit.experiments);
  if (!gauge) return tl::unexpected(gauge.error());
  fit.reference_rate = gauge->reference_rate;

  const CoordinateSettings settings{study.fit.bounds, study.fit.priors, effects.free};
  Problem problem(experiments, Parametrisation(start, wanted, settings, *gauge, experiments),
                  options.threads);
  const Parametrisation& parametrisation = problem.parametrisation();
  if (parametrisation.size() == 0) {
    return tl::unexpected(
        FitFailure{"nothing is left to fit: of the parameters listed, D_r follows from the gauge"});
  }
  FitResult& result = fit.result;
  result.free = parametrisation.free();
  result.coordinates = parametrisation.coordinates();
  result.gauge = *gauge;
  result.gauged = parametrisation.gauged();

  std::vector<std::vector<double>> candidates;
  if (options.start_from_data && study.fit.start == datasets::FitStart::data) {
    fit.start = start_values_of(fit.experiments, start, fit.reference_rate);
    candidates.push_back(start_from(*fit.start, parametrisation));
  }
  candidates.push_back(parametrisation.start());
  const auto first = first_that_predicts(problem, candidates);
  if (!first) return tl::unexpected(first.error());
  fit.first_guess = *first;
  if (options.progress) options.progress(0.02, "fit with Ceres");
  if (auto failure = find_answer(problem, *first, options.noise, options.control, fit))
    return tl::unexpected(*failure);
  MultiStart other_starts;
  if (options.depth == Depth::assessment) {
    if (options.progress) options.progress(0.05, "fits from other starts");
    auto found = try_other_starts(study, problem, options, fit);
    if (!found) return tl::unexpected(found.error());
    other_starts = std::move(*found);
  }
  if (!result.main.converged) {
    result.warnings.push_back("Ceres did not converge: " + result.main.termination);
  }

  auto uncertainty = estimate_uncertainty(problem, result.main.coordinates, Correlation::whitened);
  if (!uncertainty) return tl::unexpected(FitFailure{uncertainty.error().message});
  result.uncertainty = std::move(*uncertainty);
  result.uncertainty.degrees = fit.noise.degrees;
  const auto linearised = problem.linearise(result.main.coordinates);
  if (!linearised) return tl::unexpected(FitFailure{linearised.error().message});
  fit.white_covariance = result.uncertainty.covariance;
  result.uncertainty.covariance =
      with_remaining_correlation(problem, *linearised, fit.noise, fit.white_covariance);
  for (const ChannelNoise& channel : fit.noise.channels) {
    if (!channel.misfit) continue;
    result.warnings.push_back(
        fmt::format("{}: what is left of {} follows its own course (autocorrelation {:.3f}): it is what the "
                    "model misses, not "
                    "noise; intervals allow for it",
                    channel.test, channel.quantity, channel.model.neighbours()));
  }
  result.correlation = correlation_of(result.uncertainty.covariance);
  result.estimates = estimate_parameters(problem, result.main.coordinates, result.uncertainty);
  result.local_estimates = estimate_locals(problem, result.main.coordinates, result.uncertainty);
  result.parameters = *parametrisation.at(result.main.coordinates);
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    fit.locals.push_back(parametrisation.local_at(result.main.coordinates, i));
  }
  fit.effects = *fit.experiments.front()->effects_at(fit.locals.front());

  const auto evaluation = evaluate_all(experiments, *result.parameters, fit.locals, options.threads);
  if (!evaluation) {
    return tl::unexpected(FitFailure{"prediction at the answer: " + evaluation.error().message});
  }
  fit.evaluation = *evaluation;
  result.tests = summarise_tests(experiments, fit.evaluation);
  check_tests(problem, fit);
  if (options.depth == Depth::assessment) {
    fit.assessment.emplace();
    fit.assessment->multi_start = std::move(other_starts);
    if (auto failure = assess(study, settings, problem, wanted, options, fit))
      return tl::unexpected(*failure);
  }
  for (std::size_t k = 0; k < result.coordinates.size(); ++k) {
    if (!parametrisation.at_bound(result.main.coordinates, k)) continue;
    result.warnings.push_back(
        fmt::format("{} ends at a bound ({:.6g}): the others are at their best for it there",
                    result.coordinates[k].name, result.coordinates[k].quantity(result.main.coordinates[k])));
  }
  return fit;
}

}  // namespace isotach::calibration
