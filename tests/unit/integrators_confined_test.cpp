// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Confined compression in two components against CVODES in six, driven by strain and by stress, and the
// derivatives that it carries where the law is stiff.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "integrators/confined.hpp"
#include "integrators/integrate.hpp"
#include "integrators/steady_oedometric.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::integrators {
namespace {

using Axial = model::State<double, model::kAxial, model::Fabric::none>;

constexpr double kStress = 20e3;
constexpr double kK0 = 0.75;

Axial start() {
  Axial state;
  state.stress << -kStress, -kK0 * kStress * std::numbers::sqrt2;
  state.void_ratio = 2.2;
  return state;
}

model::State<double> general_start() {
  model::State<double> state{model::Mandel<double>::Zero(), 2.2};
  state.stress[0] = -kStress;
  state.stress[1] = state.stress[2] = -kK0 * kStress;
  return state;
}

Tolerance tight() {
  Tolerance tolerance;
  tolerance.relative = 1e-9;
  return tolerance;
}

struct Drive {
  const char* name;
  bool stress_controlled;
  double rate;  // 1/s or Pa/s, tension positive
  double duration;
};

class Confined : public testing::TestWithParam<Drive> {};

INSTANTIATE_TEST_SUITE_P(
    Drives, Confined,
    testing::Values(Drive{"loading", false, -1e-6, 5e4}, Drive{"unloading", false, 1e-6, 1e4},
                    Drive{"relaxation", false, 0.0, 1e5}, Drive{"loading_by_stress", true, -0.5, 4e4},
                    Drive{"unloading_by_stress", true, 1.0, 1e4}, Drive{"creep", true, 0.0, 1e5}),
    [](const auto& drive) { return std::string(drive.param.name); });

TEST_P(Confined, EqualsTheReferenceInSixComponents) {
  const Drive& drive = GetParam();
  const model::Law<double> law(tests::seed_mud());
  Axial state = start();
  double substep = 0.0;
  const ConfinedIncrement<double> increment{drive.stress_controlled, drive.rate, drive.duration};
  ASSERT_TRUE(integrate_confined(law, state, increment, tight(), substep));

  Increment<double> general;
  general.duration = drive.duration;
  general.stress_controlled[0] = drive.stress_controlled;
  (drive.stress_controlled ? general.stress_rate[0] : general.strain_rate[0]) = drive.rate;
  Options options;
  options.method = Method::cvode;
  const auto reference = integrate(law, general_start(), general, options);
  ASSERT_TRUE(reference);
  EXPECT_NEAR(state.stress[0], reference->state.stress[0], 3e-6 * kStress);
  EXPECT_NEAR(state.stress[1] / std::numbers::sqrt2, reference->state.stress[1], 3e-6 * kStress);
  EXPECT_NEAR(state.void_ratio, reference->state.void_ratio, 1e-7);
}

TEST(ConfinedState, BecomesOneOfSixComponents) {
  model::State<double, model::kAxial> state;
  state.stress << -4.0, -3.0 * std::numbers::sqrt2;
  state.void_ratio = 1.5;
  state.omega << 0.2, -0.1 * std::numbers::sqrt2;
  const model::State<double> general = model::general(state);
  EXPECT_DOUBLE_EQ(general.stress[0], -4.0);
  EXPECT_DOUBLE_EQ(general.stress[1], -3.0);
  EXPECT_DOUBLE_EQ(general.stress[2], -3.0);
  EXPECT_EQ(general.stress[3], 0.0);
  EXPECT_DOUBLE_EQ(general.omega[0], 0.2);
  EXPECT_DOUBLE_EQ(general.omega[2], -0.1);
}

// Long steady compression at I_v = 0.008: a method at its limit of stability would let derivatives grow from
// round-off while values stay right. ln sigma_a of steady states: d/d ln I_v = I_v ln(|D_vis|/D_r).
TEST(ConfinedDerivatives, StayBoundedInSteadyCompression) {
  using Jet = ceres::Jet<double, 1>;
  auto values = tests::seed_mud().values();
  values[model::ParameterId::I_v] = 0.008;
  model::ParameterValues<Jet> jets;
  for (std::size_t i = 0; i < model::kParameterCount; ++i) jets.values[i] = Jet(values.values[i]);
  jets[model::ParameterId::I_v].v[0] = 0.008;
  const model::Law<Jet> law(*model::Parameters<Jet>::create(jets));
  model::State<Jet, model::kAxial, model::Fabric::none> state;
  const Axial plain = start();
  for (int i = 0; i < model::kAxial; ++i) state.stress[i] = Jet(plain.stress[i]);
  state.void_ratio = Jet(plain.void_ratio);
  Tolerance tolerance;
  tolerance.relative = 3e-5;
  double substep = 0.0;
  const double rate = 2e-6;
  for (int row = 0; row < 400; ++row) {
    ASSERT_TRUE(
        integrate_confined(law, state, ConfinedIncrement<Jet>{false, Jet(-rate), 500.0}, tolerance, substep));
  }
  const Jet log_stress = log(-state.stress[0]);
  const auto steady = steady_oedometric(*model::Parameters<double>::create(values), rate);
  ASSERT_TRUE(steady);
  EXPECT_NEAR(log_stress.v[0], 0.008 * std::log(steady->viscous_rate / values[model::ParameterId::D_r]),
              2e-4);
}

}  // namespace
}  // namespace isotach::integrators
