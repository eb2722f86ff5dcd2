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
  EXPECT_NEAR(found->at.parameters.I_v() / kTrueIv, 1.0, 0.03);
  // besides the search, the error of the simulations: both tests with five kinds of numerics, and nudged
  // four times
  EXPECT_EQ(found->runs.total(), 2 * (found->search.evaluations + 9));
  for (const model::ParameterId id : {e100, lambda, kappa, D_r, phi_c, C_1}) {
    EXPECT_EQ(found->at.parameters[id], tests::seed_mud()[id]);
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
  // two tests with five kinds of numerics and four nudges besides, for the error of the simulations
  long simulations = found->search.simulations + 18;
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

// The mud is drier in the study than it was: the fit makes it wetter, in the held-out test too.
TEST(FitSlumpMud, RecoversTheVoidRatioOfTheTruth) {
  constexpr double kTrue = 5.0;
  constexpr double kStated = 4.93;  // strength 8 % above the truth's
  datasets::Study study = study_of({small_slump("one", kTrue, 1), small_slump("two", kTrue, 2)});
  for (datasets::SlumpTest& test : study.slump_tests) test.setup.mud.void_ratio = kStated;
  study.slump_tests[1].hold_out = true;
  study.fit.slump_mud = {{datasets::MudQuantity::void_ratio, {}, {}}};
  SlumpFitOptions options;
  options.map = false;
  const auto found = search_slump(study, tests::seed_mud_with(I_v, kTrueIv), {}, options);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  const auto fit = assess_slump(study, *found, {}, options);
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  ASSERT_EQ(fit->mud.size(), 1U);
  EXPECT_NEAR(fit->mud[0], kTrue, 0.015);
  ASSERT_EQ(fit->result.local_estimates.size(), 1U);
  const LocalEstimate& estimate = fit->result.local_estimates[0];
  EXPECT_EQ(estimate.name, "e0");
  EXPECT_EQ(estimate.value, fit->mud[0]);
  EXPECT_LT(estimate.ci95_lower, kTrue);
  EXPECT_GT(estimate.ci95_upper, kTrue);
  for (const TestSummary& test : fit->result.tests) EXPECT_LT(test.rms_over_noise, kAdequate) << test.name;
}

TEST(FitSlumpMud, StartsWhereThePriorPutsItAndStaysThereWhereItIsKnown) {
  datasets::Study study = study_of({small_slump("one", 5.0, 1)});
  study.slump_tests[0].setup.mud.void_ratio = 4.93;
  study.fit.slump_mud = {{datasets::MudQuantity::void_ratio, {}, 1e-4},
                         {datasets::MudQuantity::overconsolidation_ratio, {}, 1e-4}};
  const auto found = search_slump(study, tests::seed_mud_with(I_v, kTrueIv), {}, {});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  ASSERT_EQ(found->at.mud.size(), 2U);
  EXPECT_NEAR(found->at.mud[0], 4.93, 1e-3);
  EXPECT_NEAR(found->at.mud[1], study.slump_tests[0].setup.mud.overconsolidation_ratio, 1e-3);
}

/// The tests with outlines by other numerics, as if a finer code had been what was measured.
datasets::Study with_reference(datasets::Study study) {
  for (datasets::SlumpTest& test : study.slump_tests) {
    test.reference = test.setup.numerics;
    test.reference->cell_size = 0.0065;
    test.reference->scheme = mpm::Scheme::plain;
    const auto truth = mpm::run_slump(tests::seed_mud_with(I_v, kTrueIv), test.best_setup());
    if (!truth) throw std::runtime_error(truth.error().message);
    for (std::size_t k = 0; k < test.outlines.size(); ++k) {
      test.outlines[k].points.clear();
      for (const mpm::OutlinePoint& point : truth->outlines[k].points) {
        test.outlines[k].points.push_back({point.r, point.z});
      }
    }
  }
  return study;
}

// Cells of 13 mm by themselves miss the outlines, and I_v by what their error allows: three standard errors,
// for of intervals of 95 % one in twenty misses.
TEST(FitSlumpReference, FindsByQuickSimulationsWhatTheReferenceWouldSay) {
  datasets::Study study = with_reference(study_of({small_slump("wet", 5.0, 1), small_slump("dry", 4.7, 2)}));
  study.fit.slump = {I_v};
  const auto start = tests::seed_mud_with(I_v, 1.2 * kTrueIv);
  SlumpFitOptions options;
  options.map = false;
  const auto corrected = fit_slump(study, start, options);
  ASSERT_TRUE(corrected.has_value()) << corrected.error().message;
  EXPECT_NEAR(corrected->result.parameters->I_v() / kTrueIv, 1.0, 0.02);
  EXPECT_TRUE(corrected->corrections.any());
  EXPECT_EQ(corrected->corrections.failed, 0U);
  EXPECT_GT(corrected->corrections.outline, 5e-4);
  EXPECT_LT(corrected->rms_mould_gone, 3e-4);  // by the reference's own simulations
  for (datasets::SlumpTest& test : study.slump_tests) test.reference.reset();
  const auto by_itself = fit_slump(study, start, options);
  ASSERT_TRUE(by_itself.has_value()) << by_itself.error().message;
  EXPECT_GT(by_itself->rms_mould_gone, 3.0 * corrected->rms_mould_gone);
  EXPECT_GT(std::abs(by_itself->result.parameters->I_v() / kTrueIv - 1.0),
            1.5 * std::abs(corrected->result.parameters->I_v() / kTrueIv - 1.0));
  const ParameterEstimate& estimate = by_itself->result.estimates[static_cast<std::size_t>(I_v)];
  EXPECT_LT(std::abs(estimate.value - kTrueIv), 3.0 * estimate.std_error);
}

TEST(FitSlumpReference, IsTheSameAsNoneWhereItIsTheOwnNumerics) {
  datasets::Study study = study_of({small_slump("wet", 5.0, 1)});
  study.fit.slump = {I_v};
  SlumpFitOptions options;
  options.map = false;
  options.simulation_error = SimulationError{};
  options.simulation_error->error = {3e-4, 3e-4};
  const auto start = tests::seed_mud_with(I_v, 1.2 * kTrueIv);
  const auto without = search_slump(study, start, {I_v}, options);
  study.slump_tests[0].reference = study.slump_tests[0].setup.numerics;
  const auto with = search_slump(study, start, {I_v}, options);
  ASSERT_TRUE(without.has_value() && with.has_value());
  EXPECT_NEAR(with->at.parameters.I_v(), without->at.parameters.I_v(), 0.01 * kTrueIv);
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
