// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Surrogate, map and profiles against a line, whose misfit is a known parabola, and against a curved
// function.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "calibration/slump_map.hpp"
#include "tests/unit/calibration_line_experiment.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;
using tests::line;
using tests::LineExperiment;
using tests::problem_of;

const std::vector<double> kAnswer{tests::kIntercept, tests::kSlope};

Uncertainty known(const Problem& problem) {
  return *estimate_uncertainty(problem, kAnswer, Correlation::independent);
}

TEST(SlumpSurrogate, KnowsALineExactly) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const CoordinateBox box{{kAnswer[0] - 0.3, kAnswer[1] - 0.3}, {kAnswer[0] + 0.3, kAnswer[1] + 0.3}};
  TrainingSet set;
  add_points(problem, box, 20, 1, 2, {}, set);
  ASSERT_EQ(set.points.size(), 20U);
  const auto surrogate = std::make_shared<SlumpSurrogate>(problem, box, set);
  EXPECT_LT(surrogate->error(), 1e-4);
  EXPECT_EQ(surrogate->components(), 2U) << "two coordinates, two components";
  const Problem stand_in = with_surrogate(problem, surrogate);
  for (const double shift : {-0.25, 0.1, 0.28}) {
    const std::vector<double> x{kAnswer[0] + shift, kAnswer[1] - 0.5 * shift};
    EXPECT_LT((*stand_in.residuals(x) - *problem.residuals(x)).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(SlumpSurrogate, PointsThatFailAreLeftOutAndCounted) {
  LineExperiment experiment = line(0.1);
  experiment.refuse(
      [](const model::Parameters<double>& parameters) -> std::optional<experiments::PredictionFailure> {
        if (std::log(parameters.e100()) < tests::kIntercept + 0.1) return std::nullopt;
        return experiments::PredictionFailure{"too loose"};
      });
  const Problem problem = problem_of({experiment}, {e100, lambda});
  const CoordinateBox box{{kAnswer[0] - 0.3, kAnswer[1] - 0.3}, {kAnswer[0] + 0.3, kAnswer[1] + 0.3}};
  TrainingSet set;
  add_points(problem, box, 30, 1, 2, {}, set);
  EXPECT_EQ(set.failed, 10U) << "a Latin hypercube has a third of its points in a third of the range";
  EXPECT_EQ(set.last_failure, "too loose");
  EXPECT_EQ(set.points.size(), 20U);
}

TEST(SlumpMap, OfALineIsItsParabola) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const Uncertainty uncertainty = known(problem);
  const auto map = map_slump(problem, kAnswer, uncertainty, {});
  ASSERT_TRUE(map.has_value()) << map.error().message;
  ASSERT_EQ(map->profiles.size(), 2U);
  for (const Profile& profile : map->profiles) {
    const auto k = static_cast<Eigen::Index>(profile.coordinate);
    const double half = uncertainty.quantile() * std::sqrt(uncertainty.covariance(k, k));
    EXPECT_EQ(profile.lower_end, ProfileEnd::crossed);
    EXPECT_NEAR(profile.upper - kAnswer[profile.coordinate], half, 0.02 * half);
    EXPECT_NEAR(kAnswer[profile.coordinate] - profile.lower, half, 0.02 * half);
  }
  ASSERT_EQ(map->maps.size(), 1U);
  const MisfitMap& misfit = map->maps.front();
  const Eigen::MatrixXd information = uncertainty.covariance.inverse() * std::pow(uncertainty.inflation, 2.0);
  for (std::size_t i = 0; i < misfit.x.size(); i += 10) {
    for (std::size_t j = 0; j < misfit.y.size(); j += 10) {
      const Eigen::Vector2d d(misfit.x[i] - kAnswer[0], misfit.y[j] - kAnswer[1]);
      const double rise = d.dot(information * d);
      EXPECT_NEAR(misfit.rise(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), rise,
                  0.01 + 0.01 * rise);
    }
  }
  for (const OptimiserResult& route : map->routes) {
    EXPECT_NEAR(route.coordinates[0], map->best[0], 0.02 * std::sqrt(uncertainty.covariance(0, 0)))
        << route.route;
  }
}

// A standard error ten times too small makes the first box too small: it must grow until intervals are in it.
TEST(SlumpMap, GrowsUntilItHoldsTheIntervals) {
  const Problem problem = problem_of({line(10.0)}, {e100, lambda});
  Uncertainty uncertainty = known(problem);
  const double half = uncertainty.quantile() * std::sqrt(uncertainty.covariance(0, 0));
  Uncertainty wrong = uncertainty;
  wrong.covariance *= 0.01;
  const auto map = map_slump(problem, kAnswer, wrong, {});
  ASSERT_TRUE(map.has_value()) << map.error().message;
  EXPECT_GT(map->enlarged, 0);
  EXPECT_NEAR(map->profiles[0].upper - kAnswer[0], half, 0.05 * half);
}

TEST(SlumpMap, SaysWhyWhenNothingCanBeSimulated) {
  LineExperiment experiment = line(0.1);
  experiment.refuse(
      [](const model::Parameters<double>&) { return experiments::PredictionFailure{"no cell left"}; });
  const Problem problem = problem_of({experiment}, {e100, lambda});
  const auto map = map_slump(problem, kAnswer, known(problem_of({line(0.1)}, {e100, lambda})), {});
  ASSERT_FALSE(map.has_value());
  EXPECT_NE(map.error().message.find("no cell left"), std::string::npos);
}

}  // namespace
}  // namespace isotach::calibration
