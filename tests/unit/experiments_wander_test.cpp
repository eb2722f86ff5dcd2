// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slot that wanders along a test: its derivatives against differences, and against what they must be where
// it does not wander at all.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "experiments/effects_prediction.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::experiments {
namespace {

model::Parameters<double> mud() {
  model::ParameterValues<double> values;
  values.values = {1.36, 0.15, 0.015, 0.04, 7e-7, 16.0 * std::numbers::pi / 180.0, 0.05};
  return *model::Parameters<double>::create(values);
}

/// Two rates, unloading and reloading, a relaxation.
datasets::OedometerTest test_of(double height) {
  datasets::OedometerTest test{};
  test.name = "wander";
  test.height = height;
  test.diameter = 0.063;
  test.void_ratio = 2.2;
  test.initial_K0 = 0.75;
  test.initial_axial_stress = 8e3;
  test.noise = {0.01, 1.0, 1e-5};
  double time = 0.0;
  double strain = 0.0;
  const auto add = [&](double duration, double to, datasets::Stage stage) {
    for (int i = 1; i <= 8; ++i) {
      const double share = i / 8.0;
      test.record.rows.push_back({test.record.rows.size() + 2,
                                  time + share * duration,
                                  strain + share * (to - strain),
                                  20e3,
                                  stage,
                                  {},
                                  {},
                                  {}});
    }
    time += duration;
    strain = to;
  };
  add(8e4, 0.08, datasets::Stage::load);
  add(8e3, 0.12, datasets::Stage::load);
  add(5e3, 0.105, datasets::Stage::unload);
  add(1e4, 0.15, datasets::Stage::load);
  add(3e4, 0.15, datasets::Stage::relax);
  return test;
}

/// A function of the step with all of its values different.
Eigen::MatrixXd bent(const OedometerExperiment& experiment) {
  const auto rows = static_cast<Eigen::Index>(experiment.protocol().steps.size() + 1);
  Eigen::MatrixXd function(rows, 1);
  for (Eigen::Index i = 0; i < rows; ++i) function(i, 0) = std::sin(0.3 + 0.2 * static_cast<double>(i));
  return function;
}

Values predicted_with(const OedometerExperiment& experiment, Slot slot, const Eigen::MatrixXd& function,
                      double coefficient) {
  const Eigen::VectorXd change = coefficient * function.col(0);
  const std::vector<double> values(change.begin(), change.end());
  const Wander<double> wander{slot, values};
  const auto local = experiment.local_values();
  return *predict_with_effects<double>(mud(), experiment.effects().acting_on(effects::TestKind::oedometer),
                                       experiment.test(), experiment.protocol(), local, &wander);
}

class EachSlot : public testing::TestWithParam<Slot> {};

TEST_P(EachSlot, DerivativesAreThoseOfDifferences) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const effects::Effect& frame = *effects::find_effect("apparatus_compliance");
  for (const bool with_effects : {false, true}) {
    effects::Values<double> on;
    if (with_effects) {
      on = *effects::Values<double>::create(
          {effects::with_amplitude(friction, 0.1), effects::with_amplitude(frame, 2e-9)});
    }
    const OedometerExperiment experiment(test_of(0.02), on);
    const Eigen::MatrixXd function = bent(experiment);
    const auto exact = experiment.linearise_wander(mud(), experiment.local_values(), GetParam(), function);
    ASSERT_TRUE(exact.has_value()) << exact.error().message;
    const double h = 1e-2 * info_of(GetParam()).plausible;
    const Values above = predicted_with(experiment, GetParam(), function, h);
    const Values below = predicted_with(experiment, GetParam(), function, -h);
    const double largest = exact->jacobian.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    for (std::size_t i = 0; i < above.size(); ++i) {
      // substeps of three runs to a relative 3e-5 each
      EXPECT_NEAR(exact->jacobian(static_cast<Eigen::Index>(i), 0), (above[i] - below[i]) / (2.0 * h),
                  0.02 * largest)
          << info_of(GetParam()).name << (with_effects ? " with effects, value " : ", value ") << i;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, EachSlot, testing::ValuesIn(kSlots),
                         [](const auto& slot) { return std::string(info_of(slot.param).name); });

/// d values/d ln of a parameter.
Eigen::VectorXd by_log_of(const OedometerExperiment& experiment, model::ParameterId id, double scale) {
  const auto local = experiment.local_values();
  Eigen::MatrixXd direction =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model::kParameterCount + local.size()), 1);
  direction(static_cast<Eigen::Index>(id), 0) = scale;
  return experiment.linearise(mud(), local, direction)->jacobian.col(0);
}

TEST(Wander, ASlotThatStaysIsTheConstantItself) {
  const OedometerExperiment experiment(test_of(0.02));
  const auto rows = static_cast<Eigen::Index>(experiment.protocol().steps.size() + 1);
  const auto constant = [&](Slot slot) {
    return Eigen::VectorXd(
        experiment.linearise_wander(mud(), experiment.local_values(), slot, Eigen::MatrixXd::Ones(rows, 1))
            ->jacobian.col(0));
  };
  using model::ParameterId;
  const auto close = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - b).cwiseAbs().maxCoeff() < 2e-3 * b.cwiseAbs().maxCoeff();
  };
  const model::Parameters<double> m = mud();
  EXPECT_TRUE(close(constant(Slot::kappa), by_log_of(experiment, ParameterId::kappa, m.kappa())));
  EXPECT_TRUE(close(constant(Slot::lambda), by_log_of(experiment, ParameterId::lambda, m.lambda())));
  EXPECT_TRUE(close(constant(Slot::I_v), by_log_of(experiment, ParameterId::I_v, m.I_v())));
  EXPECT_TRUE(close(constant(Slot::D_r), by_log_of(experiment, ParameterId::D_r, m.D_r())));
  // ln p_B = ln(100 kPa) + (ln(1 + e100) - ln(1 + e))/lambda
  EXPECT_TRUE(close(constant(Slot::preconsolidation_pressure),
                    by_log_of(experiment, ParameterId::e100, m.lambda() * (1.0 + m.e100()))));
  // both enter only by D_r (p/p_B)^(1/I_v)
  EXPECT_TRUE(close(-m.I_v() * constant(Slot::preconsolidation_pressure), constant(Slot::D_r)));
  EXPECT_TRUE(close(constant(Slot::stress_reading), Eigen::VectorXd::Ones(rows - 1)));
  EXPECT_LT(constant(Slot::strain_reading).cwiseAbs().maxCoeff(), 1e-12)
      << "strain is counted from the start";
}

}  // namespace
}  // namespace isotach::experiments
