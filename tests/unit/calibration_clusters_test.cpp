// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Clusters of answers whose distances are known by hand.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "calibration/clusters.hpp"

namespace isotach::calibration {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;

// Standard errors 0.1 and 1: a step of 0.04 along x is 0.4 of them, of 0.1 a whole one.
MatrixXd information() {
  return Vector2d(100.0, 1.0).asDiagonal();
}

TEST(Clusters, LinkAnswersCloserThanTheRadius) {
  const std::vector<Answer> answers{{Vector2d(1.00, 0.0), 5.0},
                                    {Vector2d(0.04, 0.3), 3.2},
                                    {Vector2d(0.00, 0.0), 3.0},
                                    {Vector2d(1.04, 0.0), 4.5},
                                    {Vector2d(0.00, 5.0), 9.0}};
  const auto clusters = cluster_answers(answers, information(), 0.5);
  ASSERT_EQ(clusters.size(), 3U);
  EXPECT_EQ(clusters[0].cost, 3.0);
  EXPECT_EQ(clusters[0].best, Vector2d(0.0, 0.0));
  EXPECT_EQ(clusters[0].count, 2U);  // 0.4 and 0.3 across: 0.5 apart
  EXPECT_EQ(clusters[1].cost, 4.5);
  EXPECT_EQ(clusters[1].best, Vector2d(1.04, 0.0));
  EXPECT_EQ(clusters[1].count, 2U);
  EXPECT_EQ(clusters[2].count, 1U);
  EXPECT_EQ(cluster_answers(answers, information(), 0.49).size(), 4U);
}

// Each is 0.4 standard errors from the next, the ends 1.6 apart; given in any order of cost.
TEST(Clusters, ChainAnswersThatOthersJoin) {
  std::vector<Answer> chain;
  for (const int k : {4, 0, 2, 1, 3}) chain.push_back({Vector2d(0.04 * k, 0.0), 1.0 + (k * 7) % 5});
  const auto clusters = cluster_answers(chain, information(), 0.5);
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_EQ(clusters[0].count, 5U);
}

TEST(Clusters, AreOneAlongADirectionThatTheDataDoNotSee) {
  const MatrixXd blind = Vector2d(100.0, 0.0).asDiagonal();
  const std::vector<Answer> answers{{Vector2d(0.0, -50.0), 1.0}, {Vector2d(0.0, 50.0), 1.0}};
  EXPECT_EQ(cluster_answers(answers, blind, 0.5).size(), 1U);
}

// Costs within 0.5^2/2 = 0.125.
TEST(Clusters, GoByCostWhereInformationTellsNothing) {
  const std::vector<Answer> answers{
      {Vector2d(0.0, 0.0), 1.0}, {Vector2d(9.0, 9.0), 1.1}, {Vector2d(0.0, 0.0), 1.3}};
  const MatrixXd nan = MatrixXd::Constant(2, 2, std::numeric_limits<double>::quiet_NaN());
  for (const MatrixXd& none : {MatrixXd(MatrixXd::Zero(2, 2)), nan}) {
    const auto clusters = cluster_answers(answers, none, 0.5);
    ASSERT_EQ(clusters.size(), 2U);
    EXPECT_EQ(clusters[0].count, 2U);
  }
}

TEST(Clusters, RejectWhatIsNoAnswer) {
  EXPECT_TRUE(cluster_answers({}, information(), 0.5).empty());
  const Answer good{Vector2d(0.0, 0.0), 1.0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)cluster_answers({good}, MatrixXd::Zero(3, 3), 0.5), std::invalid_argument);
  EXPECT_THROW((void)cluster_answers({good}, information(), 0.0), std::invalid_argument);
  EXPECT_THROW((void)cluster_answers({good, {Vector2d(0.0, nan), 1.0}}, information(), 0.5),
               std::invalid_argument);
  EXPECT_THROW((void)cluster_answers({good, {Vector2d(0.0, 0.0), nan}}, information(), 0.5),
               std::invalid_argument);
  EXPECT_THROW((void)cluster_answers({good, {Eigen::VectorXd::Zero(3), 1.0}}, information(), 0.5),
               std::invalid_argument);
}

}  // namespace
}  // namespace isotach::calibration
