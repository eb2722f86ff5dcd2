// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/amplitude_interval.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calibration/distributions.hpp"
#include "calibration/fit_profile.hpp"

namespace isotach::discovery {

namespace {

/// The coordinates that are amplitudes of what a candidate adds.
std::vector<std::size_t> amplitudes_of(const calibration::Problem& problem,
                                       const std::vector<const effects::Effect*>& added) {
  const auto& coordinates = problem.parametrisation().coordinates();
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const auto& parameter = coordinates[k].effect;
    if (!parameter || parameter->index != 0) continue;
    if (std::find(added.begin(), added.end(), parameter->effect) != added.end()) found.push_back(k);
  }
  return found;
}

}  // namespace

std::vector<AmplitudeInterval> amplitude_intervals(const datasets::Study& study, const Candidate& candidate,
                                                   double level, int threads,
                                                   const calibration::OptimiserControl& control) {
  const calibration::Problem problem = calibration::problem_of(study, candidate.fit, candidate.free, threads);
  const std::vector<double>& x = candidate.fit.result.main.coordinates;
  const double quantile =
      calibration::student_t_quantile(0.5 * (1.0 + level), candidate.fit.result.uncertainty.degrees);
  std::vector<AmplitudeInterval> intervals;
  for (const std::size_t k : amplitudes_of(problem, candidate.added)) {
    const calibration::Coordinate& coordinate = problem.parametrisation().coordinates()[k];
    const calibration::Profile found =
        calibration::profile_of(candidate.fit, problem, k, quantile, control.quiet());
    intervals.push_back({coordinate.effect->effect, coordinate.quantity(x[k]),
                         coordinate.quantity(found.lower), coordinate.quantity(found.upper), found.lower_end,
                         found.upper_end});
  }
  return intervals;
}

std::vector<AmplitudeInterval> amplitude_intervals(const SlumpCandidate& candidate, double variance,
                                                   double level) {
  Eigen::MatrixXd information = candidate.at.jacobian.transpose() * candidate.at.jacobian;
  // a shape that nothing is known of counts as that
  information.diagonal().array() += 1e-12 * information.diagonal().maxCoeff();
  const Eigen::MatrixXd covariance =
      variance * information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  const double quantile = calibration::normal_quantile(0.5 * (1.0 + level));
  std::vector<AmplitudeInterval> intervals;
  for (const std::size_t k : amplitudes_of(*candidate.problem, candidate.added)) {
    const calibration::Coordinate& coordinate = candidate.problem->parametrisation().coordinates()[k];
    const auto i = static_cast<Eigen::Index>(k);
    const double half = quantile * std::sqrt(covariance(i, i));
    const double x = candidate.at.coordinates[k];
    const auto end = [](bool inside) {
      return inside ? calibration::ProfileEnd::crossed : calibration::ProfileEnd::bound;
    };
    intervals.push_back({coordinate.effect->effect, coordinate.quantity(x),
                         coordinate.quantity(std::max(x - half, coordinate.lower)),
                         coordinate.quantity(std::min(x + half, coordinate.upper)),
                         end(x - half >= coordinate.lower), end(x + half <= coordinate.upper)});
  }
  return intervals;
}

}  // namespace isotach::discovery
