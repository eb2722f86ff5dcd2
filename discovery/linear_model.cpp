// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/linear_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "calibration/effect_sensitivity.hpp"

namespace isotach::discovery {

using calibration::FitFailure;
using experiments::Linearisation;

Projection::Projection(const Eigen::MatrixXd& jacobian) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian);
  basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(jacobian.rows(), qr.rank());
}

Eigen::MatrixXd information_of(const calibration::Problem& problem, const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  const auto& coordinates = problem.parametrisation().coordinates();
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const double width = coordinates[k].upper - coordinates[k].lower;
    const auto i = static_cast<Eigen::Index>(k);
    information(i, i) += 12.0 / (width * width);  // of a uniform distribution
  }
  return information;
}

std::vector<double> matched(const std::vector<calibration::Coordinate>& wanted,
                            const std::vector<calibration::Coordinate>& all, const std::vector<double>& x) {
  std::vector<double> result;
  for (const calibration::Coordinate& one : wanted) {
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const auto& other) { return other.name == one.name; });
    result.push_back(x[static_cast<std::size_t>(same - all.begin())]);
  }
  return result;
}

LinearModel::LinearModel(calibration::Problem problem, std::vector<Linearisation> predictions,
                         calibration::Linearised at)
    : problem_(std::move(problem)),
      predictions_(std::move(predictions)),
      at_(std::move(at)),
      solver_(at_.jacobian),
      parameters_(at_.jacobian) {}

tl::expected<LinearModel, FitFailure> LinearModel::of(
    const datasets::Study& study, const Candidate& model,
    const std::vector<calibration::ExperimentWeights>& weights, const std::vector<double>& x, int threads) {
  calibration::Problem problem = calibration::problem_of(study, model.fit, model.free, threads);
  problem.set_weights(weights);
  auto predictions = problem.predictions(x);
  if (!predictions) return tl::unexpected(FitFailure{predictions.error().message});
  calibration::Linearised at = problem.linearised(x, *predictions);
  return LinearModel(std::move(problem), std::move(*predictions), std::move(at));
}

Eigen::MatrixXd LinearModel::covariance() const {
  const Eigen::MatrixXd information = information_of(problem_, at_.jacobian);
  return information.llt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

Eigen::MatrixXd LinearModel::weighted(const std::vector<Linearisation>& changes) const {
  const Eigen::MatrixXd values = problem_.weighted(changes).jacobian;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(at_.residuals.size(), values.cols());
  all.topRows(values.rows()) = values;
  return all;
}

std::vector<experiments::Values> LinearModel::left_of(const std::vector<Linearisation>& changes,
                                                      const Eigen::VectorXd& direction) const {
  const Eigen::VectorXd taken_up = solver_.solve(weighted(changes) * direction);
  std::vector<experiments::Values> left;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Eigen::VectorXd change = changes[i].jacobian * direction - predictions_[i].jacobian * taken_up;
    left.emplace_back(change.begin(), change.end());
    for (std::size_t k = 0; k < left.back().size(); ++k) left.back()[k] /= fitted()[i]->noise()[k];
  }
  return left;
}

}  // namespace isotach::discovery
