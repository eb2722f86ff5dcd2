// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fits with an effect: one that made the data is found again, and what score tests ask for is right.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/effect_sensitivity.hpp"
#include "tests/unit/effects_tests.hpp"

namespace isotach::calibration {
namespace {

using experiments::OedometerExperiment;
using experiments::Route;

/// crs_test() and the same with twice the height, read by the reference integration with an effect; half a
/// percent of noise on stress.
datasets::Study study_with(const effects::Values<double>& hidden, unsigned seed) {
  using enum model::ParameterId;
  datasets::Study study{"study.toml", {}, experiments::effects_mud(), {}, {}, {}, {}, {}};
  study.fit.oedometer = {e100, lambda, kappa, D_r};
  study.fit.starts = 2;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.005);
  for (const double height : {0.02, 0.04}) {
    datasets::OedometerTest test = experiments::crs_test();
    test.name = height < 0.03 ? "low" : "high";
    test.height = height;
    const auto path =
        OedometerExperiment(test, hidden).path(experiments::effects_mud(), {}, Route::cvode).value();
    for (std::size_t i = 0; i < test.record.rows.size(); ++i) {
      datasets::OedometerRow& row = test.record.rows[i];
      row.axial_strain = path[i + 1].axial_strain;  // behind the hold from where it ended
      if (row.stage == datasets::Stage::hold) {     // at exactly the stress held
        row.axial_strain += 2e-5 / 0.005 * noise(random);
      } else {
        row.axial_stress = path[i + 1].axial_stress * std::exp(noise(random));
      }
    }
    study.oedometer_tests.push_back(std::move(test));
  }
  return study;
}

effects::Values<double> friction(double mu) {
  return *effects::Values<double>::create(
      {effects::with_amplitude(*effects::find_effect("ring_friction"), mu)});
}

TEST(FitWithAnEffect, FindsTheFrictionThatWasHidden) {
  constexpr double kHidden = 0.08;
  const datasets::Study study = study_with(friction(kHidden), 5);
  const effects::ParameterRef mu = *effects::find_parameter("ring_friction.mu");
  OedometerFitOptions options;
  options.depth = Depth::answer;
  const auto without = fit_oedometer(study, study.material, study.fit.oedometer, options);
  ASSERT_TRUE(without) << without.error().message;
  EXPECT_FALSE(without->result.adequate);
  // from zero, where the effect is nothing
  options.depth = Depth::assessment;
  const auto with = fit_oedometer(study, study.material, study.fit.oedometer,
                                  {friction(0.0), {{mu, std::nullopt}}}, options);
  ASSERT_TRUE(with) << with.error().message;
  EXPECT_TRUE(with->result.adequate);
  ASSERT_EQ(with->result.local_estimates.size(), 1);
  const LocalEstimate& estimate = with->result.local_estimates.front();
  EXPECT_EQ(estimate.name, "ring_friction.mu");
  EXPECT_EQ(estimate.verdict, Verdict::identified);
  EXPECT_NEAR(estimate.value, kHidden, 3.0 * estimate.std_error);
  EXPECT_LT(estimate.std_error, 0.1 * kHidden);
  EXPECT_EQ(with->effects[mu], estimate.value);
  EXPECT_NEAR(with->result.parameters->lambda(), study.material.lambda(), 0.01 * study.material.lambda());
  // profiles, refits and the check by NLopt know it too
  ASSERT_TRUE(with->assessment);
  EXPECT_EQ(with->assessment->profiles.size(), with->result.coordinates.size());
  for (const Refit& refit : with->assessment->without_test) {
    EXPECT_TRUE(refit.parameters) << refit.failure;
    // friction left at its start, zero, would miss the test left out by some ten times the noise
    EXPECT_LT(refit.rms_over_noise, 2.5);
  }
  EXPECT_LT(with->result.disagreement, 0.1);
  for (const std::string& warning : with->result.warnings) ADD_FAILURE() << warning;
}

TEST(FitWithAnEffect, HeldAtItsValueIsUsedAndStays) {
  const datasets::Study study = study_with(friction(0.08), 5);
  OedometerFitOptions options;
  options.depth = Depth::answer;
  const auto fit = fit_oedometer(study, study.material, study.fit.oedometer, {friction(0.08), {}}, options);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_TRUE(fit->result.adequate);
  EXPECT_TRUE(fit->result.local_estimates.empty());
  EXPECT_EQ(fit->effects[*effects::find_parameter("ring_friction.mu")], 0.08);
}

// The score of each effect at zero of its amplitude, by the predictions' own change along a small amplitude.
TEST(EffectSensitivity, IsTheChangeOfTheWeightedResidualsAlongASmallAmplitude) {
  const datasets::Study study = study_with({}, 4);
  OedometerFitOptions options;
  options.depth = Depth::answer;
  const auto fit = fit_oedometer(study, study.material, study.fit.oedometer, options);
  ASSERT_TRUE(fit) << fit.error().message;
  const Problem problem = problem_of(study, *fit, {}, 1);
  const auto base = problem.linearise(fit->result.main.coordinates);
  ASSERT_TRUE(base);
  EXPECT_NEAR(cost_of(base->residuals), fit->result.main.cost, 1e-6 * fit->result.main.cost);
  for (const char* name : {"ring_friction", "pore_pressure", "structure"}) {
    const effects::Effect& effect = *effects::find_effect(name);
    const double small = 2e-3 * effect.parameters[0].typical_si();
    const auto at = [&](double amplitude) {
      const auto on = *effects::Values<double>::create({effects::with_amplitude(effect, amplitude)});
      const std::vector<effects::ParameterRef> by{{&effect, 0}};
      const auto predictions =
          linearise_by_effects(fit->experiments, *fit->result.parameters, fit->locals, on, by, 2);
      return problem.weighted(predictions.value());
    };
    const Linearised zero = at(0.0);
    const Linearised moved = at(small);
    ASSERT_EQ(zero.jacobian.rows(), base->jacobian.rows());
    const Eigen::VectorXd change = (moved.residuals - zero.residuals) / small;
    EXPECT_LT((change - zero.jacobian.col(0)).norm(), 0.05 * zero.jacobian.col(0).norm()) << name;
    EXPECT_LT((zero.residuals - base->residuals).norm(),
              0.05 * std::sqrt(static_cast<double>(zero.residuals.size())));
  }
}

}  // namespace
}  // namespace isotach::calibration
