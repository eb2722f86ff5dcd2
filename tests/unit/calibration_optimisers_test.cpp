// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Both routes to the minimum: a known answer, points that cannot be predicted, and being stopped.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/optimisers.hpp"
#include "tests/unit/calibration_line_experiment.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;
using tests::line;
using tests::LineExperiment;
using tests::problem_of;

enum class Route { ceres, nlopt };

class Optimiser : public testing::TestWithParam<Route> {
 protected:
  [[nodiscard]] static OptimiserResult minimise(const Problem& problem, const std::vector<double>& start,
                                                const OptimiserControl& control = {}) {
    return GetParam() == Route::ceres ? minimise_with_ceres(problem, start, {}, control)
                                      : minimise_with_nlopt(problem, start, {}, control);
  }
  /// How near to the answer a route comes: NLopt's coordinates are good to its tolerance of 1e-6.
  [[nodiscard]] static double precision() { return GetParam() == Route::ceres ? 1e-8 : 1e-5; }
};

INSTANTIATE_TEST_SUITE_P(BothRoutes, Optimiser, testing::Values(Route::ceres, Route::nlopt),
                         [](const auto& route) {
                           return route.param == Route::ceres ? std::string("Ceres") : std::string("NLopt");
                         });

// cost of line(0.1): 42 times 0.1^2
TEST_P(Optimiser, FindsTheLeastSquaresLine) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const OptimiserResult result = minimise(problem, {-0.2, -1.5});
  EXPECT_TRUE(result.converged) << result.termination;
  EXPECT_FALSE(result.interrupted);
  ASSERT_EQ(result.coordinates.size(), 2U);
  EXPECT_NEAR(result.coordinates[0], tests::kIntercept, precision());
  EXPECT_NEAR(result.coordinates[1], tests::kSlope, precision());
  EXPECT_NEAR(result.cost, 0.42, 1e-4);
  EXPECT_EQ(result.failed_evaluations, 0);
}

TEST_P(Optimiser, TracesImprovementsOnly) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const OptimiserResult result = minimise(problem, {-0.2, -1.5});
  ASSERT_GE(result.trace.size(), 2U);
  EXPECT_EQ(result.trace.front().coordinates, (std::vector<double>{-0.2, -1.5}));
  for (std::size_t i = 1; i < result.trace.size(); ++i) {
    EXPECT_LT(result.trace[i].cost, result.trace[i - 1].cost);
    EXPECT_GT(result.trace[i].evaluation, result.trace[i - 1].evaluation);
  }
  EXPECT_NEAR(result.trace.back().cost, result.cost, 1e-12);
  EXPECT_LE(result.trace.back().evaluation, result.evaluations);
}

TEST_P(Optimiser, StaysInsideItsBounds) {
  CoordinateSettings settings;
  settings.bounds[static_cast<std::size_t>(e100)] =
      datasets::Bounds{0.5, 1.1};  // the answer, exp(0.3), lies outside
  const Problem problem({std::make_shared<LineExperiment>(line(0.1))},
                        Parametrisation(tests::seed_mud(), {e100, lambda}, settings, {}), 1);
  const OptimiserResult result = minimise(problem, {-0.2, -1.5});
  EXPECT_NEAR(result.coordinates[0], std::log(1.1), precision());
  EXPECT_LE(result.coordinates[0], std::log(1.1) + 1e-15);
  // the slope is at its best for the bound, though the step that met the bound was cut off there
  EXPECT_NEAR(result.coordinates[1], tests::kSlope, precision());
}

TEST_P(Optimiser, OneCoordinateAlone) {
  const Problem problem =
      problem_of({line(0.1)}, {e100}, tests::seed_mud_with(lambda, std::exp(tests::kSlope)));
  const OptimiserResult result = minimise(problem, {-0.2});
  EXPECT_TRUE(result.converged) << result.termination;
  EXPECT_NEAR(result.coordinates[0], tests::kIntercept, precision());
}

/// Predicts 1/e100, at e100 = 1.35 as measured, and cannot below e100 = 1.
class Hyperbola final : public experiments::Experiment {
 public:
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] bool held_out() const override { return false; }
  [[nodiscard]] const experiments::Values& measured() const override { return measured_; }
  [[nodiscard]] std::string_view quantity() const override { return "1/e100 (-)"; }
  [[nodiscard]] const experiments::Values& noise() const override { return noise_; }
  [[nodiscard]] tl::expected<experiments::Values, experiments::PredictionFailure> predict(
      const model::Parameters<double>& parameters, std::span<const double> /*local*/) const override {
    if (parameters.e100() < 1.0) {
      return tl::unexpected(experiments::PredictionFailure{"e100 is too small"});
    }
    return experiments::Values{1.0 / parameters.e100()};
  }

 private:
  std::string name_ = "hyperbola";
  experiments::Values measured_{1.0 / 1.35};
  experiments::Values noise_{0.01};
};

// The Gauss-Newton step of ln e100 from e100 = 6 is (1/6 - 1/1.35)/(1/6) = -3.4: to 0.2, where nothing is
// predicted.
TEST(Ceres, PointsThatCannotBePredictedAreRefusedAndCounted) {
  const Problem problem({std::make_shared<Hyperbola>()}, Parametrisation(tests::seed_mud(), {e100}, {}, {}),
                        1);
  const OptimiserResult result = minimise_with_ceres(problem, {std::log(6.0)}, {}, {});
  EXPECT_TRUE(result.converged) << result.termination;
  EXPECT_GT(result.failed_evaluations, 0);
  EXPECT_LT(result.failed_evaluations, result.evaluations);
  EXPECT_EQ(result.last_failure, "e100 is too small");
  // the Jacobian is one of central differences over 3 %: that slows the way and leaves the answer
  // not
  EXPECT_NEAR(std::exp(result.coordinates[0]), 1.35, 1e-6);
}

TEST_P(Optimiser, NothingPredictedIsNotConverged) {
  const Problem problem = problem_of(
      {line(0.1).refuse([](const auto&) { return std::optional(experiments::PredictionFailure{"never"}); })},
      {e100, lambda});
  const OptimiserResult result = minimise(problem, {-0.2, -1.5});
  EXPECT_TRUE(result.trace.empty());
  EXPECT_EQ(result.failed_evaluations, result.evaluations);
  EXPECT_GT(result.failed_evaluations, 0);
  EXPECT_EQ(result.last_failure, "never");
  EXPECT_EQ(result.coordinates, (std::vector<double>{-0.2, -1.5}));
}

TEST_P(Optimiser, StopsSoonAfterItIsAskedTo) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  std::atomic<bool> stop{false};
  OptimiserControl control;
  control.stop = &stop;
  int evaluations_then = 0;
  control.callback = [&](int evaluations, double) {
    if (!stop) evaluations_then = evaluations;
    stop = true;
  };
  const OptimiserResult result = minimise(problem, {-0.2, -1.5}, control);
  EXPECT_TRUE(result.interrupted);
  EXPECT_FALSE(result.converged);
  EXPECT_LE(result.evaluations, evaluations_then + 1);
}

/// exp(0.3) = 1.35 is the answer; above 1.5 nothing can be predicted.
LineExperiment line_with_an_end() {
  return line(0.1).refuse(
      [](const model::Parameters<double>& parameters) -> std::optional<experiments::PredictionFailure> {
        if (parameters.e100() > 1.5) return experiments::PredictionFailure{"e100 is too large"};
        return std::nullopt;
      });
}

TEST(NLopt, RefusesPointsBeyondTheEndInTwoCoordinates) {
  const Problem problem = problem_of({line_with_an_end()}, {e100, lambda});
  // from ln 1.45 the first step of 0.1 leads beyond the end
  const OptimiserResult result = minimise_with_nlopt(problem, {std::log(1.45), -1.9}, {.restarts = 2}, {});
  EXPECT_GT(result.failed_evaluations, 0);
  EXPECT_EQ(result.last_failure, "e100 is too large");
  EXPECT_NEAR(result.coordinates[0], tests::kIntercept, 1e-4);
  EXPECT_NEAR(result.coordinates[1], tests::kSlope, 1e-4);
}

TEST(NLopt, NamesTheAlgorithmThatTheNumberOfCoordinatesCallsFor) {
  EXPECT_EQ(minimise_with_nlopt(problem_of({line(0.1)}, {e100, lambda}), {0.0, -2.0}, {}, {}).route,
            "NLopt (BOBYQA)");
  EXPECT_EQ(minimise_with_nlopt(problem_of({line(0.1)}, {e100}), {0.0}, {}, {}).route, "NLopt (COBYLA)");
}

TEST(NLopt, PredictionStoppedOnRequestIsAnInterruptionNotAFailure) {
  const Problem problem = problem_of({line(0.1).refuse([](const auto&) {
                                       return std::optional(experiments::PredictionFailure{"stopped", true});
                                     })},
                                     {e100, lambda});
  const OptimiserResult result = minimise_with_nlopt(problem, {0.0, -2.0}, {}, {});
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.failed_evaluations, 0);
}

TEST(NLopt, KeepsToItsLimitOfEvaluations) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const OptimiserResult result =
      minimise_with_nlopt(problem, {-0.2, -1.5}, {.max_evaluations = 8, .restarts = 5}, {});
  EXPECT_LE(result.evaluations, 8);
  EXPECT_FALSE(result.converged);
}

TEST(ProblemOfAFit, HeldOutTestsTakeNoPart) {
  const LineExperiment elsewhere =
      LineExperiment({{e100, tests::constant_term}}, experiments::Values(7, 9.0), tests::kNoise).hold_out();
  const Problem problem = problem_of({line(0.1), elsewhere}, {e100, lambda});
  EXPECT_EQ(problem.fitted().size(), 1U);
  EXPECT_EQ(problem.residual_count(), 7U);
  EXPECT_NEAR(cost_of(*problem.residuals({tests::kIntercept, tests::kSlope})), 0.42, 1e-9);
}

}  // namespace
}  // namespace isotach::calibration
