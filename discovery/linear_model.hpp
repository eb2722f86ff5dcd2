// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A fitted model to first order about a point: what its parameters can do, and what a change leaves of it.
#pragma once

#include <Eigen/QR>
#include <vector>

#include "discovery/candidate.hpp"

namespace isotach::discovery {

/// Frees changes of residuals of what a model's parameters can do.
class Projection {
 public:
  /// `jacobian` of the residuals by the parameters.
  explicit Projection(const Eigen::MatrixXd& jacobian);
  [[nodiscard]] Eigen::VectorXd freed(const Eigen::VectorXd& change) const {
    return change - basis_ * (basis_.transpose() * change);
  }

 private:
  Eigen::MatrixXd basis_;
};

/// Inverse covariance of a problem's coordinates: J'J of the residuals, and that of a coordinate which may
/// lie anywhere within its bounds, so that one of which the tests say nothing counts as that.
[[nodiscard]] Eigen::MatrixXd information_of(const calibration::Problem& problem,
                                             const Eigen::MatrixXd& jacobian);

/// x of the coordinates `wanted`, found by name among `all` coordinates, which have them.
[[nodiscard]] std::vector<double> matched(const std::vector<calibration::Coordinate>& wanted,
                                          const std::vector<calibration::Coordinate>& all,
                                          const std::vector<double>& x);

class LinearModel {
 public:
  /// The model by `weights` (of the fitted tests, as NoiseFit's), at the coordinates x of its fit.
  [[nodiscard]] static tl::expected<LinearModel, calibration::FitFailure> of(
      const datasets::Study& study, const Candidate& model,
      const std::vector<calibration::ExperimentWeights>& weights, const std::vector<double>& x, int threads);

  /// Weighted residuals at x, priors below.
  [[nodiscard]] const Eigen::VectorXd& residuals() const { return at_.residuals; }
  /// Inverse of information_of.
  [[nodiscard]] Eigen::MatrixXd covariance() const;
  [[nodiscard]] const Projection& parameters() const { return parameters_; }
  [[nodiscard]] const calibration::Experiments& fitted() const { return problem_.fitted(); }
  /// Predictions of the fitted tests at x, with derivatives by the coordinates, not weighted.
  [[nodiscard]] const std::vector<experiments::Linearisation>& predictions() const { return predictions_; }
  /// Changes of the fitted tests' values, a column of the Jacobians each, weighted as residuals are; rows of
  /// zeros for priors.
  [[nodiscard]] Eigen::MatrixXd weighted(const std::vector<experiments::Linearisation>& changes) const;
  /// What the parameters leave of the change of the fitted tests' values along a direction of `changes`, in
  /// units of the noise that the study states.
  [[nodiscard]] std::vector<experiments::Values> left_of(
      const std::vector<experiments::Linearisation>& changes, const Eigen::VectorXd& direction) const;

 private:
  LinearModel(calibration::Problem problem, std::vector<experiments::Linearisation> predictions,
              calibration::Linearised at);
  calibration::Problem problem_;
  std::vector<experiments::Linearisation> predictions_;
  calibration::Linearised at_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
  Projection parameters_;
};

}  // namespace isotach::discovery
