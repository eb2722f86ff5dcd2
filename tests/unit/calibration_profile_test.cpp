// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Profiles of a straight line's coordinates, which are parabolas: delta = (x - best)^2/se^2.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calibration/profile.hpp"
#include "tests/unit/calibration_line_experiment.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;
using tests::line;
using tests::LineExperiment;
using tests::problem_of;

const std::vector<double> kAnswer{tests::kIntercept, tests::kSlope};
const double kError = tests::kNoise / std::sqrt(7.0);  // of the intercept
constexpr double kThreshold = 4.0;

TEST(Profile, OfALineIsItsParabola) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const Profile found = profile(problem, kAnswer, 0, kError, kThreshold, {});
  EXPECT_EQ(found.lower_end, ProfileEnd::crossed);
  EXPECT_EQ(found.upper_end, ProfileEnd::crossed);
  EXPECT_NEAR(found.lower, tests::kIntercept - 2.0 * kError, 0.02 * kError);
  EXPECT_NEAR(found.upper, tests::kIntercept + 2.0 * kError, 0.02 * kError);
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const double z = (found.points[i].x - tests::kIntercept) / kError;
    EXPECT_NEAR(found.points[i].delta, z * z, 1e-3 * (1.0 + z * z));
    if (i > 0) {
      EXPECT_GE(found.points[i].x, found.points[i - 1].x);
    }
  }
  EXPECT_FALSE(found.better);
}

TEST(Profile, AWrongStandardErrorStillFindsTheEnds) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  for (const double factor : {0.1, 8.0}) {
    const Profile found = profile(problem, kAnswer, 0, factor * kError, kThreshold, {});
    EXPECT_EQ(found.upper_end, ProfileEnd::crossed);
    EXPECT_NEAR(found.upper, tests::kIntercept + 2.0 * kError, 0.03 * kError);
  }
}

TEST(Profile, SaysWhereABoundComesFirst) {
  CoordinateSettings settings;
  settings.bounds[static_cast<std::size_t>(e100)] =
      datasets::Bounds{0.5, std::exp(tests::kIntercept + kError)};
  const Problem problem({std::make_shared<LineExperiment>(line(0.1))},
                        Parametrisation(tests::seed_mud(), {e100, lambda}, settings, {}), 1);
  const Profile found = profile(problem, kAnswer, 0, kError, kThreshold, {});
  EXPECT_EQ(found.lower_end, ProfileEnd::crossed);
  EXPECT_EQ(found.upper_end, ProfileEnd::bound);
  EXPECT_NEAR(found.upper, tests::kIntercept + kError, 1e-9);
}

// 40 standard errors of a thousandth of the true one are too few to get anywhere
TEST(Profile, StaysOpenWhereItDoesNotRise) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const Profile found = profile(problem, kAnswer, 0, 1e-3 * kError, kThreshold, {});
  EXPECT_EQ(found.lower_end, ProfileEnd::open);
  EXPECT_EQ(found.upper_end, ProfileEnd::open);
}

// ln e100 + 2 ln kappa is all that is seen: kappa makes up for e100 until one of them meets its bound
TEST(Profile, OfANullDirectionEndsAtBounds) {
  const LineExperiment redundant({{e100, tests::constant_term}, {kappa, [](double) { return 2.0; }}},
                                 experiments::Values(7, 2.0 * std::log(0.0129) + std::log(1.358)),
                                 tests::kNoise);
  const Problem problem = problem_of({redundant}, {e100, kappa});
  const Profile found = profile(problem, problem.parametrisation().start(), 0,
                                std::numeric_limits<double>::infinity(), kThreshold, {});
  EXPECT_NE(found.lower_end, ProfileEnd::open);
  EXPECT_NE(found.upper_end, ProfileEnd::open);
  EXPECT_LT(found.lower, std::log(0.5));
  EXPECT_GT(found.upper, std::log(5.0));
}

TEST(Profile, TellsOfABetterFit) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const Profile found =
      profile(problem, {tests::kIntercept - 3.0 * kError, tests::kSlope}, 0, kError, kThreshold, {});
  EXPECT_TRUE(found.better);
}

TEST(Profile, EndsWhereNothingCanBePredicted) {
  const LineExperiment ends = line(0.1).refuse(
      [](const model::Parameters<double>& parameters) -> std::optional<experiments::PredictionFailure> {
        if (parameters.e100() > std::exp(tests::kIntercept + kError)) {
          return experiments::PredictionFailure{"e100 is too large"};
        }
        return std::nullopt;
      });
  const Problem problem = problem_of({ends}, {e100, lambda});
  const Profile found = profile(problem, kAnswer, 0, kError, kThreshold, {});
  EXPECT_EQ(found.lower_end, ProfileEnd::crossed);
  EXPECT_EQ(found.upper_end, ProfileEnd::unpredictable);
  EXPECT_LE(found.upper, tests::kIntercept + kError);
}

}  // namespace
}  // namespace isotach::calibration
