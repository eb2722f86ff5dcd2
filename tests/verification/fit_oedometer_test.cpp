// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Oedometer fits as a whole: mud-b, whose data hold an effect that the model has not, is called inadequate
// and where; synthetic tests of known parameters are recovered from the automatic start, whatever the
// protocol.
#include "calibration/fit_oedometer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "bench/synthetic_oedometer.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;

datasets::Study bundled(const char* name) {
  return datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets" / name / "study.toml");
}

tl::expected<OedometerFit, FitFailure> fit(const datasets::Study& study, Depth depth) {
  OedometerFitOptions options;
  options.threads = 2;
  options.depth = depth;
  return fit_oedometer(study, study.material, study.fit.oedometer, options);
}

TEST(FitMudB, IsInadequateAndSaysWhere) {
  const auto answer = fit(bundled("mud-b"), Depth::answer);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_FALSE(answer->result.adequate);
  ASSERT_EQ(answer->checks.size(), 3U);
  for (const TestCheck& check : answer->checks) {
    EXPECT_TRUE(check.patterned) << check.name;
    std::size_t missed = 0;
    for (const StageCheck& stage : check.stages) missed += stage.misfit;
    EXPECT_GT(missed, 0U) << check.name;
  }
  // misfit far beyond the noise widens the intervals: they are not those of mud-a
  const auto clean = fit(bundled("mud-a"), Depth::answer);
  ASSERT_TRUE(clean);
  EXPECT_TRUE(clean->result.adequate);
  for (const TestCheck& check : clean->checks) {
    for (const StageCheck& stage : check.stages)
      EXPECT_FALSE(stage.misfit) << check.name << ": " << stage.stage;
  }
  const auto error = [](const OedometerFit& of) {
    return of.result.estimates[static_cast<std::size_t>(lambda)].std_error;
  };
  EXPECT_GT(error(*answer), 5.0 * error(*clean));
}

class Recovery : public testing::TestWithParam<bench::Protocol> {};

INSTANTIATE_TEST_SUITE_P(Protocols, Recovery,
                         testing::Values(bench::Protocol::crs_steps, bench::Protocol::incremental),
                         [](const auto& which) {
                           return which.param == bench::Protocol::crs_steps ? std::string("CRS")
                                                                            : std::string("Incremental");
                         });

TEST_P(Recovery, FindsTheTruthWithinItsErrors) {
  std::mt19937_64 random(5);
  const model::Parameters<double> truth = bench::random_parameters(random);
  datasets::OedometerTest test = bench::exact_test(GetParam(), truth, 1.5);
  bench::add_noise(test, 0.01, 0.6, random);
  test.name = "synthetic";
  datasets::Study study{"synthetic", {}, bench::random_parameters(random), {}, {}, {test}, {}, {}};
  study.fit.oedometer = {e100, lambda, kappa, D_r, I_v, C_1};
  study.fit.starts = 4;
  const auto answer = fit(study, Depth::assessment);
  ASSERT_TRUE(answer) << answer.error().message;
  const FitResult& result = answer->result;
  for (const model::ParameterId id : {lambda, kappa, I_v, C_1}) {
    const ParameterEstimate& estimate = result.estimates[static_cast<std::size_t>(id)];
    EXPECT_NEAR(estimate.value, truth[id], 4.0 * estimate.std_error) << model::info(id).name;
    EXPECT_EQ(estimate.verdict, Verdict::identified) << model::info(id).name;
  }
  // what data see of e100 and D_r
  const auto invariant = [](const model::Parameters<double>& p) {
    return p.lambda() * p.I_v() * std::log(p.D_r()) - std::log1p(p.e100());
  };
  EXPECT_NEAR(invariant(*result.parameters), invariant(truth), 0.01);
  EXPECT_NEAR(answer->noise.channels[0].model.rho, 0.6, 0.25);

  ASSERT_TRUE(answer->assessment);
  const OedometerAssessment& assessment = *answer->assessment;
  ASSERT_EQ(assessment.profiles.size(), result.coordinates.size());
  for (const Profile& profile : assessment.profiles) {
    EXPECT_EQ(profile.lower_end, ProfileEnd::crossed);
    EXPECT_EQ(profile.upper_end, ProfileEnd::crossed);
  }
  EXPECT_EQ(assessment.multi_start.clusters.size(), 1U);
  EXPECT_LE(result.disagreement, 0.1);
  EXPECT_LE(assessment.integrators[0].largest_over_noise, 0.05);
  for (const OptimiserResult& search : assessment.global_searches) {
    EXPECT_NEAR(search.cost, result.main.cost, 1e-3) << search.route;
  }
}

}  // namespace
}  // namespace isotach::calibration
