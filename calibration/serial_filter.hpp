// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Frees series of values, the sum of a first-order autoregressive part and a white one, of their correlation.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace isotach::calibration {

/// The innovations of a series u_i = s_i + v_i of unit variance, in units of their standard deviations: s_i
/// of variance `share` and correlation rho^|i - j|, v_i independent, of variance 1 - share. By the filter of
/// Kalman (J. Basic Eng. 82 (1960) 35-45) for the scalar state s_i, whose prediction P_i and innovation F_i
/// have the variances
///   P_first = share,  F_i = P_i + 1 - share,  P_{i+1} = rho^2 P_i (1 - share)/F_i + share (1 - rho^2):
/// sums and products of what is not negative, exact at share = 1 (the autoregression alone) and at share = 0
/// or rho = 0 (values stay as they are). It is a triangular root of the inverse correlation matrix R, and
/// costs as many operations as there are values.
class SerialFilter {
 public:
  /// `chain_starts` as Channel's, for `count` values; rho in [0, 1), share in [0, 1].
  SerialFilter(double rho, double share, Eigen::Index count, const std::vector<std::size_t>& chain_starts);

  /// Of each column, in place.
  void apply(Eigen::Ref<Eigen::MatrixXd> values) const;

  /// ln det R.
  [[nodiscard]] double log_determinant() const { return log_determinant_; }

 private:
  Eigen::VectorXd weight_;  ///< 1/sqrt(F_i)
  Eigen::VectorXd kept_;    ///< what the next prediction keeps of the present one; 0 at the end of a chain
  Eigen::VectorXd gain_;    ///< and what it takes of the present value
  double log_determinant_ = 0.0;
};

}  // namespace isotach::calibration
