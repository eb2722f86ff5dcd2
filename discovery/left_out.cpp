// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/left_out.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "calibration/optimisers.hpp"
#include "discovery/linear_model.hpp"

namespace isotach::discovery {

namespace {

using calibration::FitFailure;

/// ln Z of a problem, sought from `start`.
tl::expected<double, FitFailure> log_evidence(const calibration::Problem& problem,
                                              const std::vector<double>& start) {
  const auto found = calibration::minimise_with_ceres(problem, start, {}, {});
  const auto at = problem.linearise(found.coordinates);
  if (!at) return tl::unexpected(FitFailure{at.error().message});
  const Eigen::MatrixXd information = information_of(problem, at->jacobian);
  const Eigen::LLT<Eigen::MatrixXd> root(information);
  if (root.info() != Eigen::Success) return tl::unexpected(FitFailure{"the information is not definite"});
  const Eigen::MatrixXd factor = root.matrixL();
  return -calibration::cost_of(at->residuals) - factor.diagonal().array().log().sum();
}

/// The fit with one of its experiments held out.
calibration::OedometerFit without(const calibration::OedometerFit& fit, std::size_t experiment) {
  calibration::OedometerFit less = fit;
  const experiments::OedometerExperiment& from = *fit.experiments[experiment];
  datasets::OedometerTest test = from.test();
  test.hold_out = true;
  less.experiments[experiment] = std::make_shared<experiments::OedometerExperiment>(
      std::move(test), from.effects(), from.free_effects());
  return less;
}

}  // namespace

tl::expected<double, FitFailure> log_predictive_density(
    const datasets::Study& study, const Candidate& candidate,
    const std::vector<calibration::ExperimentWeights>& weights, int threads) {
  const calibration::OedometerFit& fit = candidate.fit;
  calibration::Problem all = calibration::problem_of(study, fit, candidate.free, threads);
  all.set_weights(weights);
  const auto whole = log_evidence(all, fit.result.main.coordinates);
  if (!whole) return tl::unexpected(whole.error());
  double sum = 0.0;
  std::size_t fitted = 0;
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) {
    if (fit.experiments[i]->held_out()) continue;
    calibration::Problem others = calibration::problem_of(study, without(fit, i), candidate.free, threads);
    std::vector<calibration::ExperimentWeights> rest = weights;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(fitted++));
    others.set_weights(std::move(rest));
    const auto part =
        log_evidence(others, matched(others.parametrisation().coordinates(),
                                     all.parametrisation().coordinates(), fit.result.main.coordinates));
    if (!part) return tl::unexpected(part.error());
    sum += *whole - *part;
  }
  return sum;
}

}  // namespace isotach::discovery
