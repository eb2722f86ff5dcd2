// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How far an oedometer fit can be trusted: other routes and starts, profiles, other data and inputs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibration/fit_profile.hpp"
#include "calibration/parallel.hpp"
#include "calibration/profile_verdict.hpp"
#include "calibration/uncertainty.hpp"

namespace isotach::calibration {

namespace {

constexpr double kAgreement = 0.1;  // standard errors

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

/// The box of the global searches: within the bounds, a factor of three about the answer.
GlobalOptions box_about(const Problem& problem, const std::vector<double>& x, unsigned seed) {
  constexpr double kFactor = 3.0;
  GlobalOptions options;
  options.seed = seed;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Coordinate& coordinate = problem.parametrisation().coordinates()[k];
    const double half = coordinate.logarithmic ? std::log(kFactor) : coordinate.search_width(x[k]);
    options.lower.push_back(std::max(coordinate.lower, x[k] - half));
    options.upper.push_back(std::min(coordinate.upper, x[k] + half));
  }
  return options;
}

IntegratorCheck compare_integrators(const experiments::OedometerExperiment& experiment,
                                    const model::Parameters<double>& parameters,
                                    const std::vector<double>& local) {
  IntegratorCheck check{experiment.name(), 0.0, 0.0, {}};
  const auto values = experiment.predict(parameters, local);
  const auto path = experiment.path(parameters, local, experiments::Route::cvode);
  if (!values || !path) {
    check.failure = values ? path.error().message : values.error().message;
    return check;
  }
  const experiments::Values reference = experiment.values_of(*path);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double difference = std::abs((*values)[i] - reference[i]) / experiment.noise()[i];
    if (difference > check.largest_over_noise) {
      check.largest_over_noise = difference;
      check.at_time = experiment.row_of(experiment.values()[i]).time;
    }
  }
  return check;
}

}  // namespace

std::optional<FitFailure> assess(const datasets::Study& study, const CoordinateSettings& settings,
                                 const Problem& problem, const std::vector<model::ParameterId>& wanted,
                                 const OedometerFitOptions& options, OedometerFit& fit) {
  FitResult& result = fit.result;
  const std::vector<double>& x = result.main.coordinates;
  OedometerAssessment& assessment = *fit.assessment;
  Problem serial = problem;
  serial.set_threads(1);
  const OptimiserControl quiet = options.control.quiet();
  const auto report = [&](double fraction, const char* what) {
    if (options.progress) options.progress(fraction, what);
  };
  const bool unique = result.uncertainty.null_directions.empty();

  report(0.25, "profile likelihood");
  assessment.profiles.resize(x.size());
  const double quantile = result.uncertainty.quantile();
  parallel_for(x.size(), options.threads,
               [&](std::size_t k) { assessment.profiles[k] = profile_of(fit, serial, k, quantile, quiet); });
  if (quiet.stopped()) return FitFailure{"interrupted", true};
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Profile& found = assessment.profiles[k];
    if (k < result.free.size()) {
      heed_profile(found, result.estimates[static_cast<std::size_t>(result.free[k])]);
    } else {
      heed_profile(found, result.local_estimates[k - result.free.size()]);
    }
    if (found.better) {
      result.warnings.push_back(fmt::format("the profile of {} met a better fit than the one reported",
                                            result.coordinates[k].name));
    }
  }

  report(0.5, "NLopt, local and global");
  // without a gauge there is no single answer to agree on
  if (unique) {
    NloptOptions nlopt;
    nlopt.coordinate_tolerance = 1e-7;
    nlopt.restarts = 2;
    std::vector<OptimiserResult> routes(3);
    parallel_for(routes.size(), options.threads, [&](std::size_t i) {
      if (i == 0) {
        routes[i] = minimise_with_nlopt(serial, fit.first_guess, nlopt, quiet);
      } else {
        routes[i] = search_globally(serial, i == 1 ? GlobalSearch::crs2 : GlobalSearch::isres, x,
                                    box_about(problem, x, study.fit.seed), quiet);
      }
    });
    if (quiet.stopped()) return FitFailure{"interrupted", true};
    result.check = std::move(routes[0]);
    assessment.global_searches = {std::move(routes[1]), std::move(routes[2])};
    result.disagreement = disagreement(result.main, *result.check, result.uncertainty);
    if (!(result.disagreement <= kAgreement)) {
      result.warnings.push_back(
          fmt::format("Ceres and NLopt differ by {:.2g} standard errors (cost {:.6g} and {:.6g}): treat the "
                      "answer with care",
                      result.disagreement, result.main.cost, result.check->cost));
    }
    for (const OptimiserResult& search : assessment.global_searches) {
      if (search.cost < result.main.cost - kBetterCost) {
        result.warnings.push_back(
            fmt::format("{} found a better fit than the one reported: cost {:.6g} instead of {:.6g}",
                        search.route, search.cost, result.main.cost));
      }
    }
  }

  report(0.8, "other data and inputs");
  const RefitBase base{settings,           fit.experiments, problem,         x,    fit.noise.weights,
                       result.uncertainty, wanted,          options.threads, quiet};
  assessment.without_test = leave_one_out(base);
  assessment.shifted_inputs = shift_inputs(base);
  if (quiet.stopped()) return FitFailure{"interrupted", true};

  report(0.9, "integrators");
  assessment.integrators.resize(fit.experiments.size());
  parallel_for(fit.experiments.size(), options.threads, [&](std::size_t i) {
    assessment.integrators[i] = compare_integrators(*fit.experiments[i], *result.parameters, fit.locals[i]);
  });
  constexpr double kIntegration = 0.1;  // of the noise
  for (const IntegratorCheck& check : assessment.integrators) {
    if (!check.failure.empty()) {
      result.warnings.push_back("CVODE could not follow " + check.failure);
    } else if (check.largest_over_noise > kIntegration) {
      result.warnings.push_back(fmt::format("{}: the integrators differ by {:.2g} of the noise", check.test,
                                            check.largest_over_noise));
    }
  }
  if (study.fit.bootstrap > 0) {
    report(0.92, "bootstrap");
    assessment.bootstrap =
        bootstrap(problem, fit.noise, x, {study.fit.bootstrap, study.fit.seed, options.threads}, quiet);
    if (quiet.stopped()) return FitFailure{"interrupted", true};
  }
  report(1.0, "done");
  return std::nullopt;
}

}  // namespace isotach::calibration
