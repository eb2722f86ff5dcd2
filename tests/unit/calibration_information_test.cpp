// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Laws of information, on random Jacobians: by the inverse of J'J where it exists.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "calibration/information.hpp"

namespace isotach::calibration {
namespace {

constexpr Interest kPair{1, 3};

/// Rows of a test in five coordinates of very different scale.
Eigen::MatrixXd jacobian(unsigned seed, Eigen::Index rows) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd J(rows, 5);
  const double scale[] = {300.0, 20.0, 1.0, 5.0, 0.02};
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index k = 0; k < 5; ++k) J(i, k) = scale[k] * normal(random);
  }
  return J;
}

Eigen::MatrixXd information(const Eigen::MatrixXd& J) {
  return J.transpose() * J;
}

TEST(Information, MarginalisedIsThePairsBlockOfTheCovariance) {
  const Eigen::MatrixXd M = information(jacobian(1, 12));
  const Eigen::MatrixXd covariance = M.inverse();
  const Outlook outlook = outlook_of(M, kPair);
  EXPECT_NEAR(outlook.first, std::sqrt(covariance(1, 1)), 1e-9 * outlook.first);
  EXPECT_NEAR(outlook.second, std::sqrt(covariance(3, 3)), 1e-9 * outlook.second);
  EXPECT_NEAR(outlook.correlation, covariance(1, 3) / std::sqrt(covariance(1, 1) * covariance(3, 3)), 1e-9);
  const double det = covariance(1, 1) * covariance(3, 3) - covariance(1, 3) * covariance(1, 3);
  EXPECT_NEAR(outlook.log_det, std::log(det), 1e-8);
}

TEST(Information, OfTwoTestsIsThatOfTheirDataTogether) {
  const Eigen::MatrixXd a = jacobian(1, 9);
  const Eigen::MatrixXd b = jacobian(2, 4);
  Eigen::MatrixXd both(13, 5);
  both << a, b;
  const Outlook sum = outlook_of(information(a) + information(b), kPair);
  const Outlook stacked = outlook_of(information(both), kPair);
  EXPECT_NEAR(sum.log_det, stacked.log_det, 1e-10);
  EXPECT_NEAR(sum.first, stacked.first, 1e-10);
}

TEST(Information, AnIndependentDuplicateHalvesTheVariance) {
  const Eigen::MatrixXd M = information(jacobian(3, 8));
  const Outlook once = outlook_of(M, kPair);
  const Outlook twice = outlook_of(2.0 * M, kPair);
  EXPECT_NEAR(twice.first, once.first / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(twice.second, once.second / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(once.log_det - twice.log_det, 2.0 * std::log(2.0), 1e-9) << "two variances, each halved";
}

TEST(Information, AddingATestNeverLoses) {
  const Eigen::MatrixXd M = information(jacobian(4, 7));
  const Outlook before = outlook_of(M, kPair);
  for (unsigned seed = 10; seed < 60; ++seed) {
    const Outlook after = outlook_of(M + information(jacobian(seed, 1 + seed % 5)), kPair);
    EXPECT_LE(after.first, before.first * (1.0 + 1e-12));
    EXPECT_LE(after.second, before.second * (1.0 + 1e-12));
    EXPECT_LE(after.log_det, before.log_det + 1e-12);
  }
}

TEST(Information, HoldingTheOthersNeverTellsMoreErrorThanFindingThem) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::MatrixXd M = information(jacobian(seed, 8));
    EXPECT_LE(outlook_of_held(M, kPair).first, outlook_of(M, kPair).first);
    EXPECT_LE(outlook_of_held(M, kPair).second, outlook_of(M, kPair).second);
  }
}

TEST(Information, WhatNoDatumSeesHasNoError) {
  Eigen::MatrixXd J = jacobian(5, 10);
  J.col(1) = 4.0 * J.col(0);  // the first of the pair cannot be told from a nuisance
  const Outlook outlook = outlook_of(information(J), kPair);
  EXPECT_TRUE(std::isinf(outlook.first));
  EXPECT_TRUE(std::isfinite(outlook.second));
  EXPECT_TRUE(std::isinf(outlook.log_det));
  EXPECT_TRUE(std::isnan(outlook.correlation));
  EXPECT_TRUE(std::isinf(outlook_of(Eigen::MatrixXd::Zero(5, 5), kPair).second));
}

TEST(Information, ANullDirectionOfNuisancesDoesNotMatter) {
  Eigen::MatrixXd J = jacobian(6, 10);
  J.col(4) = J.col(0);
  const Eigen::MatrixXd without = J(Eigen::all, {0, 1, 2, 3});
  EXPECT_NEAR(outlook_of(information(J), kPair).log_det, outlook_of(information(without), kPair).log_det,
              1e-8);
}

TEST(Information, KnowledgeOfTheOthersIsTheInverseOfTheirCovariance) {
  const Eigen::MatrixXd M = information(jacobian(7, 12));
  const std::vector<Eigen::Index> rest{0, 2, 4};
  const Eigen::MatrixXd expected = Eigen::MatrixXd(M.inverse()(rest, rest)).inverse();
  const Eigen::MatrixXd knowledge = knowledge_of_others(M, kPair);
  EXPECT_LT((knowledge(rest, rest) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_EQ(knowledge.row(1).norm(), 0.0);
  EXPECT_EQ(knowledge.col(3).norm(), 0.0);
}

TEST(Information, DirectionsHeldAreThoseWithAnErrorBelowOne) {
  EXPECT_EQ(directions_held(Eigen::Vector3d(4.0, 1.5, 0.5).asDiagonal()), 2);
}

}  // namespace
}  // namespace isotach::calibration
