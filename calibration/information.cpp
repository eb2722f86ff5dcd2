// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/information.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

namespace isotach::calibration {

namespace {

constexpr double kUnseen = 1e-11;  // eigenvalue of information scaled to a unit diagonal: rounding

/// Indices of all coordinates but the two.
std::vector<Eigen::Index> others(Eigen::Index size, const Interest& interest) {
  std::vector<Eigen::Index> rest;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (i != interest.first && i != interest.second) rest.push_back(i);
  }
  return rest;
}

/// 1/sqrt of the diagonal, 0 where that is 0.
Eigen::VectorXd scale_of(const Eigen::MatrixXd& matrix) {
  return matrix.diagonal().unaryExpr([](double d) { return d > 0.0 ? 1.0 / std::sqrt(d) : 0.0; });
}

/// The pseudo-inverse of a symmetric positive semi-definite matrix, judged in a unit diagonal.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd scale = scale_of(matrix);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * matrix *
                                                              scale.asDiagonal());
  const Eigen::VectorXd inverted =
      solver.eigenvalues().unaryExpr([](double value) { return value > kUnseen ? 1.0 / value : 0.0; });
  return scale.asDiagonal() * solver.eigenvectors() * inverted.asDiagonal() *
         solver.eigenvectors().transpose() * scale.asDiagonal();
}

/// The information on `kept`, `dropped` marginalised.
Eigen::MatrixXd marginal(const Eigen::MatrixXd& information, const std::vector<Eigen::Index>& kept,
                         const std::vector<Eigen::Index>& dropped) {
  const Eigen::MatrixXd between = information(kept, dropped);
  return information(kept, kept) -
         between * pseudo_inverse(information(dropped, dropped)) * between.transpose();
}

/// Of a 2 x 2 information, of which `whole` is what it was before others were marginalised.
Outlook outlook_of_pair(const Eigen::Matrix2d& information, const Eigen::Matrix2d& whole) {
  Outlook outlook;
  const Eigen::Vector2d scale = scale_of(whole);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scale.asDiagonal() * information *
                                                              scale.asDiagonal());
  const Eigen::Vector2d& values = solver.eigenvalues();
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  bool whole_rank = true;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Eigen::Vector2d direction = scale.asDiagonal() * solver.eigenvectors().col(k);
    if (values[k] > kUnseen) {
      variance += direction.cwiseAbs2() / values[k];
      covariance += direction * direction.transpose() / values[k];
      continue;
    }
    whole_rank = false;
    for (Eigen::Index i = 0; i < 2; ++i) {
      constexpr double kPart = 1e-6;  // of a unit direction
      if (scale[i] == 0.0 || std::abs(solver.eigenvectors()(i, k)) > kPart) {
        variance[i] = std::numeric_limits<double>::infinity();
      }
    }
  }
  outlook.first = std::sqrt(variance[0]);
  outlook.second = std::sqrt(variance[1]);
  if (!whole_rank) return outlook;
  outlook.covariance = covariance;
  outlook.correlation = covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1));
  outlook.log_det = std::log(covariance.determinant());
  return outlook;
}

}  // namespace

Outlook outlook_of(const Eigen::MatrixXd& information, const Interest& interest) {
  const std::vector<Eigen::Index> kept{interest.first, interest.second};
  return outlook_of_pair(marginal(information, kept, others(information.rows(), interest)),
                         information(kept, kept));
}

Outlook outlook_of_held(const Eigen::MatrixXd& information, const Interest& interest) {
  const std::vector<Eigen::Index> kept{interest.first, interest.second};
  return outlook_of_pair(information(kept, kept), information(kept, kept));
}

Eigen::MatrixXd knowledge_of_others(const Eigen::MatrixXd& information, const Interest& interest) {
  const std::vector<Eigen::Index> kept = others(information.rows(), interest);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(information.rows(), information.cols());
  result(kept, kept) = marginal(information, kept, {interest.first, interest.second});
  return result;
}

int directions_held(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information, Eigen::EigenvaluesOnly);
  return static_cast<int>((solver.eigenvalues().array() > 1.0).count());
}

}  // namespace isotach::calibration
