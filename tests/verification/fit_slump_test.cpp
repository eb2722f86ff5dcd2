// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The slump fit against a known truth: outlines of simulated slumps, read with a little noise.
#include "calibration/fit_slump.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "mpm/slump.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;

constexpr double kTrueIv = 0.05;
constexpr double kReading = 0.2e-3;  // m, standard deviation of a point of the outline

/// A slump of a low fill with coarse cells: quick. The mud is wet enough (C_u at D_r 31 and 43 Pa) to flow at
/// any I_v tried: a fill of 40 mm stands up to about 100 Pa, and mud that stands holds no I_v.
datasets::SlumpTest small_slump(const std::string& name, double void_ratio, unsigned seed) {
  datasets::SlumpTest test{name, {}, {}, {}, {kReading, kReading, 0.0}, false};
  test.setup.mould.fill_height = 0.04;
  test.setup.mud.void_ratio = void_ratio;
  test.setup.numerics.cell_size = 0.013;
  test.setup.times = {0.5, 1.0};

  const auto truth = mpm::run_slump(tests::seed_mud_with(I_v, kTrueIv), test.setup);
  if (!truth) throw std::runtime_error(truth.error().message);
  std::mt19937 random(seed);
  std::normal_distribution<double> reading(0.0, kReading);
  for (const mpm::Outline& outline : truth->outlines) {
    datasets::Outline read{outline.time, {}};
    for (const mpm::OutlinePoint& point : outline.points) {
      read.points.push_back({point.r + reading(random), point.z + reading(random)});
    }
    test.outlines.push_back(std::move(read));
  }
  return test;
}

datasets::Study study_of(std::vector<datasets::SlumpTest> tests) {
  return {.file = {},
          .material = tests::seed_mud(),
          .fit = {},
          .oedometer_tests = {},
          .slump_tests = std::move(tests),
          .assumptions = {}};
}

class FitSlump : public testing::TestWithParam<double> {};

// I_v 30 % below and 30 % above the truth
INSTANTIATE_TEST_SUITE_P(Starts, FitSlump, testing::Values(0.7, 1.3),
                         [](const auto& start) { return start.param < 1.0 ? "Below" : "Above"; });

TEST_P(FitSlump, RecoversTheIvOfTheTruth) {
  const datasets::Study study = study_of({small_slump("wet", 5.0, 1), small_slump("dry", 4.7, 2)});
  const auto found = search_slump(study, tests::seed_mud_with(I_v, GetParam() * kTrueIv), {I_v}, {});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_TRUE(found->search.converged) << found->search.termination;
  EXPECT_NEAR(found->parameters.I_v() / kTrueIv, 1.0, 0.03);
  // besides the search, the error of the simulations: both tests with four kinds of numerics
  EXPECT_EQ(found->runs.total(), 2 * (found->search.evaluations + 4));
  for (const model::ParameterId id : {e100, lambda, kappa, D_r, phi_c, C_1}) {
    EXPECT_EQ(found->parameters[id], tests::seed_mud()[id]);
  }
}

TEST(FitSlumpRoutes, EndAtTheSameAnswerAndEachIsCounted) {
  datasets::Study study = study_of({small_slump("wet", 5.0, 1), small_slump("dry", 4.7, 2)});
  SlumpFitOptions options;
  using enum datasets::SlumpRoute;
  options.routes = {bobyqa, sbplx, ceres};
  const auto found = search_slump(study, tests::seed_mud_with(I_v, 1.3 * kTrueIv), {I_v}, options);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  ASSERT_EQ(found->others.size(), 2U);
  // two tests with four kinds of numerics besides, for the error of the simulations
  long simulations = found->search.simulations + 8;
  EXPECT_GT(found->search.simulations, 0);
  for (const OptimiserResult& route : found->others) {
    EXPECT_GE(route.cost, found->search.cost) << route.route;
    // each search stops within 0.01 in ln I_v
    EXPECT_NEAR(route.coordinates[0], found->search.coordinates[0], 0.02) << route.route;
    EXPECT_GT(route.simulations, 0) << route.route;
    simulations += route.simulations;
  }
  EXPECT_EQ(found->runs.total(), simulations);
}

TEST(FitSlumpAssessment, HoldsTheTruthInItsIntervalAndCallsTheFitAdequate) {
  datasets::Study study = study_of({small_slump("wet", 5.0, 1), small_slump("dry", 4.7, 2)});
  study.slump_tests[1].hold_out = true;
  study.fit.slump = {I_v};
  const auto fit = fit_slump(study, tests::seed_mud_with(I_v, 1.3 * kTrueIv), {});
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  const ParameterEstimate& estimate = fit->result.estimates[static_cast<std::size_t>(I_v)];
  EXPECT_LT(estimate.ci95_lower, kTrueIv * 1.01);
  EXPECT_GT(estimate.ci95_upper, kTrueIv * 0.99);
  EXPECT_EQ(estimate.verdict, Verdict::identified);
  EXPECT_TRUE(fit->result.adequate);
  ASSERT_EQ(fit->result.tests.size(), 2U);
  EXPECT_FALSE(fit->result.tests[0].held_out);
  EXPECT_TRUE(fit->result.tests[1].held_out);
  // the truth predicts the test that was held out as well
  for (const TestSummary& test : fit->result.tests) {
    EXPECT_LT(test.rms_over_noise, kAdequate) << test.name;
  }
}

TEST(FitSlumpFailure, IsInterruptedOnRequest) {
  const datasets::Study study = study_of({small_slump("wet", 5.0, 1)});
  const std::atomic<bool> stop{true};
  SlumpFitOptions options;
  options.control.stop = &stop;
  const auto found = search_slump(study, tests::seed_mud(), {I_v}, options);
  ASSERT_FALSE(found.has_value());
  EXPECT_TRUE(found.error().interrupted);
}

}  // namespace
}  // namespace isotach::calibration
