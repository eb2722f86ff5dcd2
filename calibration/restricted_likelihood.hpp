// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The restricted likelihood of a channel's noise as a function of its level, floor and correlation, fast
// enough to search.
#pragma once

#include "calibration/noise_model.hpp"

namespace isotach::calibration {

/// Throws std::invalid_argument where the channel is not as Channel and estimate_noise want it, but for what
/// concerns its residuals and Jacobian.
void require_consistent_noise(const Channel& channel, Eigen::Index count);

/// -2 times the restricted log-likelihood of estimate_noise. The buffers of an evaluation are allocated once.
class RestrictedLikelihood {
 public:
  /// Throws as estimate_noise does.
  RestrictedLikelihood(const Channel& channel, const Eigen::MatrixXd& other_information,
                       const Eigen::VectorXd& other_gradient, const NoiseModel& start);

  /// Value at the best rho, and that rho.
  struct Profile {
    double value;  ///< infinite where some sd_i is 0
    double rho;
  };
  [[nodiscard]] Profile at(double level, double floor);

  /// Value where `share` of the variance has the correlation `rho` and the rest has none; infinite where some
  /// sd_i is 0.
  [[nodiscard]] double at(double level, double floor, double rho, double share);

 private:
  /// Values over sd, and the logarithms of the variances; false where some sd_i is 0.
  bool scale(double level, double floor);
  double at_rho(double rho);
  /// With the whitened products in factor_ and ln det S.
  double reduced(double log_determinant);
  void reduce(const Eigen::MatrixXd& information, const Eigen::MatrixXd& other_information,
              const Eigen::VectorXd& other_gradient);

  const Channel& channel_;
  Eigen::ArrayXd inverse_stress2_;
  double correlated_;  ///< values that have one before them in their chain

  // coordinates y in which the information at the start is the unit matrix, null directions left out
  Eigen::MatrixXd values_;            ///< n x (r + 1): Jacobian in y, residuals
  Eigen::MatrixXd other_;             ///< (r + 1) x (r + 1): H in y and g in y, 0 in the corner
  double change_of_variables_ = 0.0;  ///< ln det of the information at the start, in the fit's coordinates

  // of one evaluation
  Eigen::ArrayXd variance_;
  Eigen::ArrayXd weight_;
  Eigen::MatrixXd scaled_;      ///< values over sd
  Eigen::MatrixXd white_;       ///< the same freed of their correlation
  Eigen::MatrixXd products_;    ///< sum of u u'
  Eigen::MatrixXd neighbours_;  ///< sum of u_i u_{i-1}' + u_{i-1} u_i' within chains
  Eigen::MatrixXd ends_;        ///< sum of u u' over the first and the last of each chain
  Eigen::MatrixXd factor_;
  double log_variances_ = 0.0;
};

}  // namespace isotach::calibration
