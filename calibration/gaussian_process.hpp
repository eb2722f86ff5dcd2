// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A smooth function of a few inputs, learnt from scattered values that carry noise.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace isotach::calibration {

/// Universal kriging (Rasmussen & Williams 2006, ch. 2 and 5): a polynomial trend, and on it a Gaussian
/// process with the squared exponential kernel (what is learnt is smooth), a length for each input, and noise
/// of one variance. Lengths and noise
/// are those of the largest restricted likelihood (trend and variance integrated out), by NLopt's BOBYQA from
/// three starts.
class GaussianProcess {
 public:
  /// `inputs` has a row for each of the values, about the unit cube; more values than 2 + the number of
  /// inputs. The trend is quadratic where values are twice its terms or more, else linear.
  GaussianProcess(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& values);

  [[nodiscard]] double mean(const Eigen::VectorXd& input) const;
  /// Variance of the function at `input`, noise not included.
  [[nodiscard]] double variance(const Eigen::VectorXd& input) const;

  /// Standard deviation of the noise.
  [[nodiscard]] double noise() const { return noise_; }
  /// Correlation lengths by input.
  [[nodiscard]] const Eigen::VectorXd& lengths() const { return lengths_; }
  /// Each value minus its prediction from all others, at the lengths and noise of all.
  [[nodiscard]] const Eigen::VectorXd& left_out() const { return left_out_; }

 private:
  [[nodiscard]] Eigen::VectorXd trend(const Eigen::VectorXd& input) const;
  [[nodiscard]] Eigen::VectorXd correlations(const Eigen::VectorXd& input) const;

  Eigen::MatrixXd inputs_;
  bool quadratic_;
  Eigen::VectorXd lengths_;
  double variance_ = 0.0;
  double noise_ = 0.0;
  Eigen::LLT<Eigen::MatrixXd> factor_;        ///< of the correlations, noise included
  Eigen::MatrixXd solved_trend_;              ///< K^-1 B
  Eigen::LLT<Eigen::MatrixXd> trend_factor_;  ///< of B' K^-1 B
  Eigen::VectorXd coefficients_;
  Eigen::VectorXd weights_;  ///< K^-1 (y - B beta)
  Eigen::VectorXd left_out_;
};

}  // namespace isotach::calibration
