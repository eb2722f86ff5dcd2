// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/fit_oedometer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "calibration/uncertainty.hpp"

namespace isotach::calibration {

namespace {

tl::expected<GaugeChoice, FitFailure> choose_gauge(const datasets::Study& study, const OedometerFit& fit) {
  GaugeChoice gauge{study.fit.gauge, 0.0};
  if (gauge.kind != datasets::Gauge::crs_rate) return gauge;
  if (study.fit.reference_rate) {
    gauge.reference_rate = *study.fit.reference_rate;
    return gauge;
  }
  for (const auto& experiment : fit.experiments) {
    if (experiment->held_out()) continue;
    if (const auto rate = experiment->first_loading_rate()) {
      gauge.reference_rate = *rate;
      return gauge;
    }
  }
  return tl::unexpected(
      FitFailure{"no fitted oedometer test has a loading stage to take the gauge's rate from; "
                 "give [fit] reference_rate_per_s"});
}

// Largest difference of the two answers in standard errors.
double disagreement(const OptimiserResult& a, const OptimiserResult& b, const Uncertainty& uncertainty) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.coordinates.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double error = std::sqrt(uncertainty.covariance(i, i));
    largest = std::max(largest, std::abs(a.coordinates[k] - b.coordinates[k]) / error);
  }
  return largest;
}

}  // namespace

tl::expected<OedometerFit, FitFailure> fit_oedometer(const datasets::Study& study,
                                                     const model::Parameters<double>& start,
                                                     const std::vector<model::ParameterId>& wanted,
                                                     const OedometerFitOptions& options) {
  OedometerFit fit;
  Experiments experiments;
  for (const auto& test : study.oedometer_tests) {
    fit.experiments.push_back(std::make_shared<experiments::OedometerExperiment>(test));
    experiments.push_back(fit.experiments.back());
  }
  const auto gauge = choose_gauge(study, fit);
  if (!gauge) return tl::unexpected(gauge.error());
  fit.reference_rate = gauge->reference_rate;

  const Problem problem(experiments, Parametrisation(start, wanted, study.fit.bounds, *gauge),
                        options.threads);
  const Parametrisation& parametrisation = problem.parametrisation();
  FitResult& result = fit.result;
  result.free = parametrisation.free();
  result.gauge = *gauge;
  result.gauged = parametrisation.gauged();
  if (const auto first = problem.evaluate(parametrisation.start()); !first) {
    return tl::unexpected(FitFailure{"the start values cannot predict the tests: " + first.error().message});
  }

  result.main = minimise_with_ceres(problem, parametrisation.start(), {}, options.control);
  if (result.main.interrupted) return tl::unexpected(FitFailure{"interrupted", true});
  if (!result.main.converged) {
    result.warnings.push_back("Ceres did not converge: " + result.main.termination);
  }
  for (std::size_t k = 0; k < result.free.size(); ++k) {
    constexpr double kAtBound = 1e-9;
    const double x = result.main.coordinates[k];
    if (x - parametrisation.lower()[k] < kAtBound || parametrisation.upper()[k] - x < kAtBound) {
      result.warnings.push_back(fmt::format(
          "{} ends at a bound: the other parameters may have stopped short of their best values there",
          model::info(result.free[k]).name));
    }
  }
  auto uncertainty = estimate_uncertainty(problem, result.main.coordinates, Correlation::independent);
  if (!uncertainty) return tl::unexpected(FitFailure{uncertainty.error().message});
  result.uncertainty = std::move(*uncertainty);
  result.correlation = correlation_of(result.uncertainty.covariance);
  result.estimates = estimate_parameters(problem, result.main.coordinates, result.uncertainty);
  result.parameters = *parametrisation.at(result.main.coordinates);

  // without a gauge there is no single answer to agree on
  if (options.check_with_nlopt && result.uncertainty.null_directions.empty()) {
    NloptOptions nlopt;
    nlopt.coordinate_tolerance = 1e-7;
    nlopt.restarts = 2;
    result.check = minimise_with_nlopt(problem, parametrisation.start(), nlopt, options.control);
    if (result.check->interrupted) return tl::unexpected(FitFailure{"interrupted", true});
    result.disagreement = disagreement(result.main, *result.check, result.uncertainty);
    constexpr double kAgreement = 0.1;  // standard errors
    if (!(result.disagreement <= kAgreement)) {
      result.warnings.push_back(
          fmt::format("Ceres and NLopt differ by {:.2g} standard errors (cost {:.6g} and {:.6g}): treat the "
                      "answer with care",
                      result.disagreement, result.main.cost, result.check->cost));
    }
  }

  const auto evaluation = evaluate_all(experiments, *result.parameters, options.threads);
  if (!evaluation)
    return tl::unexpected(FitFailure{"prediction at the answer: " + evaluation.error().message});
  fit.evaluation = *evaluation;
  result.tests = summarise_tests(experiments, fit.evaluation);
  result.adequate = true;
  for (const TestSummary& test : result.tests) {
    if (!test.held_out && test.rms_over_noise > kAdequate) result.adequate = false;
  }
  return fit;
}

}  // namespace isotach::calibration
