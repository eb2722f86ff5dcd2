// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Errors that all tests share: directions in which residuals are known less well.
#pragma once

#include <Eigen/Core>
#include <utility>

namespace isotach::calibration {

/// Residuals r have the covariance I + Q Q', each column of Q being what one cause does to all of them at
/// once. The rest of that error, as neighbours of one test share it, is in what decorrelates r.
class CommonError {
 public:
  /// None.
  CommonError() = default;
  /// `directions` are the columns of Q, for the first rows of residuals; those below them are not touched.
  explicit CommonError(Eigen::MatrixXd directions);

  [[nodiscard]] bool any() const { return sizes_.size() > 0; }
  /// With further causes beside these, of as many rows.
  [[nodiscard]] CommonError with(const Eigen::MatrixXd& more) const;
  /// Of residuals that follow `rows` others.
  [[nodiscard]] CommonError below(Eigen::Index rows) const;

  /// (I + Q Q')^(-1/2) r.
  [[nodiscard]] Eigen::MatrixXd whitened(Eigen::MatrixXd residuals) const {
    return scaled(std::move(residuals), -0.5);
  }
  /// Back again.
  [[nodiscard]] Eigen::MatrixXd as_read(Eigen::MatrixXd whitened) const {
    return scaled(std::move(whitened), 0.5);
  }

 private:
  /// (I + Q Q')^power times.
  [[nodiscard]] Eigen::MatrixXd scaled(Eigen::MatrixXd residuals, double power) const;

  Eigen::MatrixXd directions_;
  Eigen::MatrixXd basis_;  ///< orthonormal
  Eigen::VectorXd sizes_;  ///< singular values of Q
};

}  // namespace isotach::calibration
