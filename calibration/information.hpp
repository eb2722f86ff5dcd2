// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What information matrices say of two coordinates when all others have to be found along with them.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace isotach::calibration {

/// Two coordinates of interest among those of an information matrix J'C^-1J.
struct Interest {
  Eigen::Index first;
  Eigen::Index second;
};

/// How well the two would be known.
struct Outlook {
  double first = std::numeric_limits<double>::infinity();         ///< standard error; infinite: not held
  double second = std::numeric_limits<double>::infinity();        ///< likewise
  double correlation = std::numeric_limits<double>::quiet_NaN();  ///< NaN where one is not held
  /// ln of the determinant of their covariance; infinite where a combination of the two is not held.
  double log_det = std::numeric_limits<double>::infinity();
  Eigen::Matrix2d covariance =
      Eigen::Matrix2d::Constant(std::numeric_limits<double>::infinity());  ///< where both are held
};

/// The two, all others marginalised: the inverse of the Schur complement of the others. `information` is
/// symmetric and positive semi-definite; directions that it does not see may be in it.
[[nodiscard]] Outlook outlook_of(const Eigen::MatrixXd& information, const Interest& interest);

/// The same as if the others were known exactly.
[[nodiscard]] Outlook outlook_of_held(const Eigen::MatrixXd& information, const Interest& interest);

/// What `information` says of all coordinates but the two, once these are marginalised: rows and columns of
/// the two are zero. Added to another test's information it stands for what is known of the nuisances alone.
[[nodiscard]] Eigen::MatrixXd knowledge_of_others(const Eigen::MatrixXd& information,
                                                  const Interest& interest);

/// Number of directions in coordinate space along which the standard error is below 1: a factor of e where
/// coordinates are logarithms.
[[nodiscard]] int directions_held(const Eigen::MatrixXd& information);

}  // namespace isotach::calibration
