// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/secant_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace isotach::calibration {

namespace {

constexpr double kLongestStep = 1.0;  // of a logarithm; of an effect, in its typical values, kEffectSteps
constexpr double kEffectSteps = 4.0;
constexpr double kShorter = 0.35;
constexpr int kMostShorter = 2;

double room_of(const Coordinate& coordinate, double longest) {
  return coordinate.effect && !coordinate.logarithmic ? kEffectSteps * longest : longest;
}

/// What a step found that the Jacobian did not: the least change that explains it, columns weighed by what
/// they do.
void correct(SecantPoint& at, const Eigen::VectorXd& step, const Eigen::VectorXd& residuals) {
  const Eigen::VectorXd weights = at.jacobian.colwise().squaredNorm().transpose();
  const Eigen::VectorXd weighed = weights.cwiseProduct(step);
  const double length = step.dot(weighed);
  if (!(length > 0.0)) return;
  at.jacobian += (residuals - at.residuals - at.jacobian * step) * (weighed / length).transpose();
}

/// The step from a point to the least of |r + J dx| with the coordinates within their bounds and no further
/// than `longest` (of each; logarithms and numbers of typical values) from where they are.
Eigen::VectorXd bounded_step(const Problem& problem, const SecantPoint& at, double longest) {
  const auto& coordinates = problem.parametrisation().coordinates();
  const auto n = static_cast<Eigen::Index>(coordinates.size());
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
  std::vector<bool> held(coordinates.size());
  for (std::size_t k = 0; k < held.size(); ++k) {
    held[k] = at.jacobian.col(static_cast<Eigen::Index>(k)).isZero(0.0);
  }
  // coordinates that would leave their room are held at its side, and the others find their least again
  for (std::size_t pass = 0; pass <= held.size(); ++pass) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!held[static_cast<std::size_t>(k)]) free.push_back(k);
    }
    if (free.empty()) break;
    Eigen::VectorXd rest = at.residuals;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (held[static_cast<std::size_t>(k)]) rest += at.jacobian.col(k) * step[k];
    }
    const Eigen::MatrixXd columns = at.jacobian(Eigen::all, free);
    const Eigen::VectorXd found = columns.colPivHouseholderQr().solve(-rest);
    bool left = false;
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto k = static_cast<std::size_t>(free[i]);
      const double x = at.coordinates[k];
      const double room = room_of(coordinates[k], longest);
      const double lower = std::max(coordinates[k].lower - x, -room);
      const double upper = std::min(coordinates[k].upper - x, room);
      const double wanted = found[static_cast<Eigen::Index>(i)];
      step[free[i]] = std::clamp(wanted, lower, upper);
      if (wanted < lower || wanted > upper) held[k] = left = true;
    }
    if (!left) break;
  }
  return step;
}

}  // namespace

SecantFit minimise_by_secants(const Problem& problem, const SecantPoint& start, const SecantOptions& options,
                              const OptimiserControl& control) {
  SecantFit fit;
  fit.at = start;
  double longest = kLongestStep;
  int shorter = 0;
  while (fit.evaluations < options.max_evaluations) {
    const Eigen::VectorXd step = bounded_step(problem, fit.at, longest);
    const double promised = cost_of(fit.at.residuals + fit.at.jacobian * step);
    if (fit.at.cost() - promised < options.cost_tolerance) {
      fit.converged = true;
      break;
    }
    if (control.stopped()) {
      fit.interrupted = true;
      break;
    }
    std::vector<double> x = fit.at.coordinates;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += step[static_cast<Eigen::Index>(k)];
    ++fit.evaluations;
    auto residuals = problem.residuals(x);
    if (control.callback) control.callback(fit.evaluations, fit.at.cost());
    if (!residuals) {
      fit.interrupted = residuals.error().interrupted;
      if (fit.interrupted) break;
    } else {
      if (options.map) *residuals = options.map(std::move(*residuals));
      correct(fit.at, step, *residuals);
      if (cost_of(*residuals) < fit.at.cost()) {
        fit.at.coordinates = std::move(x);
        fit.at.residuals = std::move(*residuals);
        shorter = 0;
        continue;
      }
    }
    if (++shorter > kMostShorter) break;
    double largest = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Coordinate& coordinate = problem.parametrisation().coordinates()[k];
      largest = std::max(largest, std::abs(step[static_cast<Eigen::Index>(k)]) / room_of(coordinate, 1.0));
    }
    longest = kShorter * largest;
  }
  return fit;
}

}  // namespace isotach::calibration
