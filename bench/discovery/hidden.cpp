// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/hidden.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "experiments/oedometer_experiment.hpp"

namespace isotach::bench {

tl::expected<std::vector<double>, std::string> exact_log_stress(const datasets::OedometerTest& test,
                                                                const model::Parameters<double>& truth,
                                                                const Hidden& hidden) {
  if (hidden.outside) return log_stress_with(test, truth, *hidden.outside);
  const auto values = effects::Values<double>::create(hidden.effects);
  if (!values) return tl::unexpected(values.error().message());
  const experiments::OedometerExperiment experiment(test, *values);
  const auto path = experiment.path(truth, {}, experiments::Route::cvode);
  if (!path) return tl::unexpected(path.error().message);
  std::vector<double> readings;
  for (const experiments::PathPoint& point : *path) {
    if (point.row == experiments::kNoRow) continue;
    if (!(point.axial_stress > 0.0)) return tl::unexpected(test.name + ": the reading falls to nothing");
    readings.push_back(std::log(point.axial_stress));
  }
  return readings;
}

Eigen::MatrixXd ReadingNoise::covariance(Eigen::Index count) const {
  Eigen::MatrixXd result(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double serial = kShare * std::pow(kCorrelation, static_cast<double>(std::abs(i - j)));
      result(i, j) = level * level * (serial + (i == j ? 1.0 - kShare : 0.0));
    }
  }
  return result;
}

std::vector<double> ReadingNoise::draw(std::size_t count, std::mt19937_64& random) const {
  std::normal_distribution<double> normal;
  std::vector<double> errors;
  double serial = normal(random);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) {
      serial = kCorrelation * serial + std::sqrt(1.0 - kCorrelation * kCorrelation) * normal(random);
    }
    errors.push_back(level * (std::sqrt(kShare) * serial + std::sqrt(1.0 - kShare) * normal(random)));
  }
  return errors;
}

Visibility::Visibility(const std::vector<datasets::OedometerTest>& tests,
                       const std::vector<std::vector<double>>& base, const model::Parameters<double>& truth,
                       const std::vector<model::ParameterId>& free, ReadingNoise noise)
    : level_(noise.level) {
  calibration::Experiments all;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (tests[i].hold_out) continue;
    all.push_back(std::make_shared<experiments::OedometerExperiment>(tests[i]));
    fitted_.push_back(i);
    base_.push_back(base[i]);
  }
  // without a gauge: e100 and D_r are one direction, which the rank takes care of
  const calibration::Problem problem(
      all, calibration::Parametrisation(truth, free, {}, {datasets::Gauge::none, 0.0}, all), 1);
  const auto at = problem.predictions(problem.parametrisation().start());
  if (!at) throw std::runtime_error(at.error().message);
  Eigen::Index rows = 0;
  for (const auto& one : *at) rows += one.jacobian.rows();
  white_jacobian_.resize(rows, static_cast<Eigen::Index>(problem.parametrisation().size()));
  Eigen::Index row = 0;
  for (const auto& one : *at) {
    const Eigen::Index count = one.jacobian.rows();
    roots_.emplace_back(noise.covariance(count).llt().matrixL());
    jacobians_.push_back(one.jacobian);
    white_jacobian_.middleRows(row, count) = roots_.back().triangularView<Eigen::Lower>().solve(one.jacobian);
    row += count;
  }
  qr_.compute(white_jacobian_);
}

Eigen::VectorXd Visibility::white(const std::vector<Eigen::VectorXd>& changes) const {
  Eigen::VectorXd result(white_jacobian_.rows());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const Eigen::Index count = changes[k].size();
    result.segment(row, count) = roots_[k].triangularView<Eigen::Lower>().solve(changes[k]);
    row += count;
  }
  return result;
}

Left Visibility::left_of(const std::vector<std::vector<double>>& readings) const {
  std::vector<Eigen::VectorXd> changes;
  for (std::size_t k = 0; k < fitted_.size(); ++k) {
    const auto count = static_cast<Eigen::Index>(base_[k].size());
    changes.emplace_back(Eigen::Map<const Eigen::VectorXd>(readings[fitted_[k]].data(), count) -
                         Eigen::Map<const Eigen::VectorXd>(base_[k].data(), count));
  }
  const Eigen::VectorXd change = white(changes);
  const Eigen::VectorXd step = qr_.solve(change);
  Left left;
  left.white = change - white_jacobian_ * step;
  left.norm = left.white.norm();
  for (std::size_t k = 0; k < changes.size(); ++k) {
    left.plain.emplace_back((changes[k] - jacobians_[k] * step) / level_);
  }
  return left;
}

double Visibility::norm_beside(const Eigen::VectorXd& white_change,
                               const std::vector<Eigen::VectorXd>& white_directions) const {
  const auto more = static_cast<Eigen::Index>(white_directions.size());
  Eigen::MatrixXd all(white_jacobian_.rows(), white_jacobian_.cols() + more);
  all.leftCols(white_jacobian_.cols()) = white_jacobian_;
  for (Eigen::Index k = 0; k < more; ++k) {
    all.col(white_jacobian_.cols() + k) = white_directions[static_cast<std::size_t>(k)];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(all);
  return (white_change - all * qr.solve(white_change)).norm();
}

}  // namespace isotach::bench
