// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the numerics of simulations do alike to all tests: directions in which residuals are known less well.
#pragma once

#include <Eigen/Core>
#include <tl/expected.hpp>
#include <utility>

#include "discovery/slump_candidate.hpp"

namespace isotach::discovery {

/// Residuals r have the covariance I + Q Q', the columns of Q being what each change of the numerics does to
/// all of them at once. The rest of that error, as neighbours of one test share it, is in what decorrelates
/// r.
class CommonError {
 public:
  CommonError() = default;
  /// `directions` are the columns Q, for the first rows of residuals; priors follow.
  explicit CommonError(const Eigen::MatrixXd& directions);

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

  Eigen::MatrixXd basis_;  ///< orthonormal
  Eigen::VectorXd sizes_;  ///< singular values of Q
};

/// By the variants of the simulations' error that were measured, and, where the study names no reference
/// numerics, by the other scheme of transfer, which is simulated at the basis' start: codes differ by it, and
/// so may data that come from one. A variant that failed in some test gives no direction.
[[nodiscard]] tl::expected<CommonError, calibration::FitFailure> common_error(const SlumpBasis& basis,
                                                                              const SlumpTests& tests);

}  // namespace isotach::discovery
