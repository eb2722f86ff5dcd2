// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Errors that all residuals share, against dense linear algebra and closed forms of least squares.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "calibration/common_error.hpp"
#include "calibration/uncertainty.hpp"
#include "tests/unit/calibration_line_experiment.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;
using tests::line;
using tests::problem_of;

const std::vector<double> kAnswer{tests::kIntercept, tests::kSlope};

Eigen::MatrixXd some_directions() {
  Eigen::MatrixXd directions(4, 2);
  directions << 1.0, 0.2, -0.5, 2.0, 0.3, 0.7, 0.0, -1.1;
  return directions;
}

/// (I + Q Q')^(-1/2) by eigenvectors.
Eigen::MatrixXd inverse_root(const Eigen::MatrixXd& directions) {
  const Eigen::Index n = directions.rows();
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n) + directions * directions.transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).operatorInverseSqrt();
}

TEST(CommonError, WhitensByTheRootOfTheCovariance) {
  const Eigen::VectorXd r = Eigen::Vector4d(1.0, -2.0, 0.5, 3.0);
  const CommonError error(some_directions());
  const Eigen::VectorXd whitened = error.whitened(r);
  EXPECT_LT((whitened - inverse_root(some_directions()) * r).norm(), 1e-13);
  EXPECT_LT((error.as_read(whitened) - r).norm(), 1e-13);
}

TEST(CommonError, OfNoCausesChangesNothing) {
  const Eigen::VectorXd r = Eigen::Vector4d(1.0, -2.0, 0.5, 3.0);
  EXPECT_EQ(CommonError().whitened(r), r);
  EXPECT_FALSE(CommonError(Eigen::MatrixXd(4, 0)).any());
}

TEST(CommonError, TakesFurtherCausesInAnyOrder) {
  const Eigen::MatrixXd all = some_directions();
  const Eigen::VectorXd r = Eigen::Vector4d(1.0, -2.0, 0.5, 3.0);
  const CommonError first = CommonError(all.col(1)).with(all.col(0));
  EXPECT_LT((first.whitened(r) - CommonError(all).whitened(r)).norm(), 1e-13);
  EXPECT_LT((CommonError().with(all).whitened(r) - CommonError(all).whitened(r)).norm(), 1e-13);
}

TEST(CommonError, LeavesWhatStandsAboveAndBelow) {
  const Eigen::VectorXd r = Eigen::Vector4d(1.0, -2.0, 0.5, 3.0);
  Eigen::VectorXd more(7);
  more << 8.0, 9.0, r, 10.0;
  const Eigen::VectorXd whitened = CommonError(some_directions()).below(2).whitened(more);
  EXPECT_EQ(whitened.head(2), more.head(2));
  EXPECT_EQ(whitened.tail(1), more.tail(1));
  EXPECT_LT((whitened.segment(2, 4) - CommonError(some_directions()).whitened(r)).norm(), 1e-13);
}

// With V = I + Q Q' the covariance of the coordinates is (J' V^-1 J)^-1 (Aitken's), and the residuals' sum of
// squares r' V^-1 r.
TEST(CommonError, OfAProblemMakesItGeneralisedLeastSquares) {
  Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const std::vector<double> x{kAnswer[0] + 0.05, kAnswer[1] - 0.02};
  const Linearised plain = *problem.linearise(x);
  const Eigen::Index rows = plain.residuals.size();
  Eigen::MatrixXd directions(rows, 2);
  for (Eigen::Index i = 0; i < rows; ++i) {
    directions(i, 0) = 0.8;
    directions(i, 1) = std::sin(static_cast<double>(i));
  }
  problem.set_common_error(CommonError(directions));
  const Eigen::MatrixXd V = Eigen::MatrixXd::Identity(rows, rows) + directions * directions.transpose();
  const Eigen::LLT<Eigen::MatrixXd> factor(V);
  const Eigen::VectorXd residuals = *problem.residuals(x);
  EXPECT_NEAR(residuals.squaredNorm(), plain.residuals.dot(factor.solve(plain.residuals)), 1e-10);
  const Linearised whitened = *problem.linearise(x);
  EXPECT_LT((whitened.residuals - residuals).norm(), 1e-12);
  const Eigen::Matrix2d expected = (plain.jacobian.transpose() * factor.solve(plain.jacobian)).inverse();
  const auto uncertainty = estimate_uncertainty(problem, x, Correlation::whitened);
  ASSERT_TRUE(uncertainty);
  EXPECT_LT((uncertainty->covariance - expected).norm(), 1e-9 * expected.norm());
}

// An error that looks like a change s of one coordinate adds s^2 to its variance and nothing to the other's,
// whatever the number of values.
TEST(CommonError, LikeACoordinateAddsToItsVariance) {
  Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const Eigen::MatrixXd before = estimate_uncertainty(problem, kAnswer, Correlation::whitened)->covariance;
  constexpr double kSize = 0.3;
  problem.set_common_error(CommonError(kSize * problem.linearise(kAnswer)->jacobian.col(1)));
  const Eigen::MatrixXd after = estimate_uncertainty(problem, kAnswer, Correlation::whitened)->covariance;
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(2, 2);
  added(1, 1) = kSize * kSize;
  EXPECT_LT((after - before - added).norm(), 1e-9);
}

}  // namespace
}  // namespace isotach::calibration
