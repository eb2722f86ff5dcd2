// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Discovery on readings made from the protocols of mud-a: nothing hidden, and an effect hidden. Generator and
// fitter are the same code here; how often names are right is another question.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "discovery/discover.hpp"

namespace isotach::discovery {
namespace {

/// The oedometer tests of mud-a with stresses that the model gives, with `effects`, and independent noise of
/// the size that the study states.
datasets::Study hidden(const effects::Values<double>& effects) {
  datasets::Study study =
      datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
  study.slump_tests.clear();
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (datasets::OedometerTest& test : study.oedometer_tests) {
    const experiments::OedometerExperiment experiment(test, effects, {});
    const auto predicted = experiment.predict(study.material, experiment.local_values());
    if (!predicted) throw std::runtime_error(predicted.error().message);
    for (std::size_t i = 0; i < predicted->size(); ++i) {
      const experiments::ComparedValue& value = experiment.values()[i];
      test.record.rows[value.row].axial_stress =
          std::exp((*predicted)[i] + experiment.noise()[i] * normal(random));
    }
  }
  return study;
}

calibration::OedometerFitOptions quick() {
  calibration::OedometerFitOptions options;
  options.threads = 2;
  options.depth = calibration::Depth::answer;
  return options;
}

Discovery discovered(const datasets::Study& study) {
  auto found = discover_oedometer(study, {.threads = 2, .control = {}, .progress = {}});
  if (!found) throw std::runtime_error(found.error().message);
  return std::move(*found);
}

TEST(Discovery, ModelThatMadeTheDataSuffices) {
  const Discovery found = discovered(hidden({}));
  EXPECT_EQ(found.verdict, Verdict::adequate);
  EXPECT_GT(found.p_value, 0.002);
  EXPECT_NEAR(found.base.gap.fitted, 1.0, 0.1);
  EXPECT_NEAR(found.smoother, 1.08, 0.1) << "sqrt(1 + 1/6) of independent noise";
  EXPECT_FALSE(found.chosen);
}

TEST(Discovery, HiddenRingFrictionIsNamed) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  constexpr double kFriction = 0.1;
  const Discovery found =
      discovered(hidden(*effects::Values<double>::create({effects::with_amplitude(friction, kFriction)})));
  ASSERT_EQ(found.verdict, Verdict::named) << name_of(found.verdict);
  const Trial& named = found.trials[*found.chosen];
  ASSERT_EQ(named.candidate.added.size(), 1U);
  EXPECT_EQ(named.candidate.added.front()->name, "ring_friction");
  EXPECT_NEAR((named.candidate.fit.effects[effects::ParameterRef{&friction, 0}]), kFriction, 0.2 * kFriction);
  EXPECT_GT(found.base.gap.fitted, 1.3);
  EXPECT_NEAR(named.gap.fitted, 1.0, 0.1);
  EXPECT_LT(named.gap.held_out, found.base.gap.held_out);
  EXPECT_NEAR(named.gap.held_out, 1.0, 0.2);
  EXPECT_GE(found.best_wrong, named.gap.fitted);
}

TEST(Discovery, ScoresAreThoseOfLeastSquares) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(friction, 0.02)}));
  auto base = fit_with(study, study.material, {}, quick());
  ASSERT_TRUE(base.has_value()) << base.error().message;
  auto with = fit_with(study, study.material, {&friction}, quick());
  ASSERT_TRUE(with.has_value()) << with.error().message;
  // a weak effect: the gain of the full fit is the square of the score, by the same noise
  weigh_alike(study, {&*base, &*with}, 2);
  const auto scores = score(study, *base, {&friction}, with->fit.noise.weights, 2);
  ASSERT_TRUE(scores.has_value()) << scores.error().message;
  EXPECT_NEAR(std::sqrt(base->chi_squared - with->chi_squared) / std::sqrt(scores->best.front()), 1.0, 0.1);
  for (const Signature& signature : scores->signatures) {
    EXPECT_NEAR(signature.unit.norm(), 1.0, 1e-9);
    EXPECT_GT(signature.absorbed, 0.5) << "one ring, one direction at a time: most is taken up";
  }
}

}  // namespace
}  // namespace isotach::discovery
