// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/common_error.hpp"

#include <Eigen/SVD>

namespace isotach::calibration {

CommonError::CommonError(Eigen::MatrixXd directions) : directions_(std::move(directions)) {
  if (directions_.cols() == 0) return;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(directions_, Eigen::ComputeThinU);
  basis_ = svd.matrixU();
  sizes_ = svd.singularValues();
}

CommonError CommonError::with(const Eigen::MatrixXd& more) const {
  if (!any()) return CommonError(more);
  Eigen::MatrixXd all(directions_.rows(), directions_.cols() + more.cols());
  all << directions_, more;
  return CommonError(std::move(all));
}

CommonError CommonError::below(Eigen::Index rows) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows + directions_.rows(), directions_.cols());
  all.bottomRows(directions_.rows()) = directions_;
  return CommonError(std::move(all));
}

Eigen::MatrixXd CommonError::scaled(Eigen::MatrixXd residuals, double power) const {
  if (!any()) return residuals;
  const Eigen::VectorXd factors = (1.0 + sizes_.array().square()).pow(power) - 1.0;
  auto values = residuals.topRows(basis_.rows());
  const Eigen::MatrixXd parts = basis_.transpose() * values;
  values += basis_ * (factors.asDiagonal() * parts);
  return residuals;
}

}  // namespace isotach::calibration
