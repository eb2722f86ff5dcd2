// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The anisotropic form under integration: switched off it is the isotropic one to the last bit; switched on
// it follows its closed form and rotates with the body.
#include <gtest/gtest.h>

#include <string>

#include "integrators/integrate.hpp"
#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::set_a;
using tests::set_a_values;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

model::Parameters<double> rotating_set(double C_1, double C_2, double C_3) {
  auto values = set_a_values();
  values[model::ParameterId::C_1] = C_1;
  values[model::ParameterId::C_2] = C_2;
  values[model::ParameterId::C_3] = C_3;
  return model::Parameters<double>::create(values).value();
}

TEST(AnisotropicForm, SwitchedOffIsTheIsotropicOneToTheLastBit) {
  const Law law(set_a(0.1));
  Vector6 shear = compression_rate(1e-6, -4e-7, 2e-7);
  shear.tail<3>() << 5e-7, -3e-7, 2e-7;
  Increment<double> creep;
  creep.duration = 1e5;
  creep.stress_controlled.fill(true);
  Increment<double> spinning = strain_increment<double>(shear, 2e4);
  spinning.spin << 1e-6, -2e-6, 5e-7;
  const State start{stress_kPa(110.0, 80.0, 75.0), 1.5};
  for (const auto& increment : {strain_increment<double>(shear, 3e4), creep, spinning}) {
    const auto inclined = integrate_fellin_ostermann(law, start, increment, Tolerance{}).value();
    const auto upright =
        integrate_fellin_ostermann(law, model::in_form<model::Fabric::none>(start), increment, Tolerance{})
            .value();
    EXPECT_EQ(inclined.state.stress, upright.state.stress);
    EXPECT_EQ(inclined.state.void_ratio, upright.state.void_ratio);
    EXPECT_EQ(inclined.strain, upright.strain);
    EXPECT_EQ(inclined.state.omega, Vector6::Zero());
  }
}

TEST(AnisotropicForm, TheFormWithOmegaGivesTheSameAtAnOmegaOfZero) {
  // C_2 of 1e-300 keeps Omega at zero but takes the form with Omega; compilers may contract products and sums
  // of the two differently, so that the last bits may differ
  auto values = set_a(0.1).values();
  const Law upright(set_a(0.1));
  values[model::ParameterId::C_2] = 1e-300;
  const Law inclined(model::Parameters<double>::create(values).value());
  Vector6 shear = compression_rate(1e-6, -4e-7, 2e-7);
  shear.tail<3>() << 5e-7, -3e-7, 2e-7;
  const State start{stress_kPa(110.0, 80.0, 75.0), 1.5};
  const auto increment = strain_increment<double>(shear, 3e4);
  EXPECT_FALSE(inclined.stays_upright(start));
  const auto a = integrate_fellin_ostermann(inclined, start, increment, Tolerance{}).value();
  const auto b = integrate_fellin_ostermann(upright, start, increment, Tolerance{}).value();
  EXPECT_EQ(a.statistics.accepted, b.statistics.accepted);
  EXPECT_LE((a.state.stress - b.state.stress).norm(), 1e-12 * b.state.stress.norm());
  EXPECT_LE(a.state.omega.norm(), 1e-290);
}

class EveryIntegrator : public testing::TestWithParam<Method> {};

INSTANTIATE_TEST_SUITE_P(Forms, EveryIntegrator, testing::ValuesIn(kMethods),
                         [](const auto& method) { return tests::test_name(method.param); });

TEST_P(EveryIntegrator, OmegaApproachesItsAttractorWithViscousStrain) {
  // All stresses held: T*/p stays x, and Omega = C_3 x (1 - exp(-C_2 eps_vis)) with eps_vis the time integral
  // of |D_vis|, here by the trapezoidal rule over rows of 50 s, short against the 8000 s in which creep slows
  // down: its error is (50/8000)^2/12 = 3e-6.
  const Law law(rotating_set(0.0, 60.0, 0.4));
  const Vector6 stress = stress_kPa(130.0, 85.0, 85.0);
  Increment<double> hold;
  hold.duration = 50.0;
  hold.stress_controlled.fill(true);
  State state{stress, 1.44};
  const Vector6 ratio = law.measures(stress).ratio;
  double viscous_strain = 0.0;
  const auto viscous_rate = [&law](const State& at) {
    return law.viscous_rate(law.measures(at).equivalent_pressure, at.void_ratio);
  };
  for (int row = 0; row < 8000; ++row) {
    const double before = viscous_rate(state);
    const auto end = integrate(law, state, hold, tests::tight(GetParam()));
    ASSERT_TRUE(end) << end.error().message();
    state = end->state;
    viscous_strain += 0.5 * hold.duration * (before + viscous_rate(state));
  }
  EXPECT_GT(60.0 * viscous_strain, 0.5);  // of the way to the attractor
  const Vector6 expected = ratio * (0.4 * (1.0 - std::exp(-60.0 * viscous_strain)));
  EXPECT_LE((state.omega - expected).norm(), 1e-5 * expected.norm());
}

TEST_P(EveryIntegrator, SpinTurnsOmegaAndStressAlike) {
  // with D = 0 and a viscosity that has no time, a spin w turns both by the angle w t about axis 3
  const Law law(rotating_set(0.0, 60.0, 0.4));
  Increment<double> turn;
  turn.duration = 0.5;
  turn.spin << 1.0, 0.0, 0.0;
  State start{stress_kPa(120.0, 90.0, 90.0), 1.0};  // OCR 5: D_vis is 1e-20 /s
  start.omega.head<3>() << -0.2, 0.1, 0.1;
  const auto end = integrate(law, start, turn, tests::tight(GetParam()));
  ASSERT_TRUE(end) << end.error().message();
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  // W12 = (dv1/dx2 - dv2/dx1)/2 > 0 turns from axis 2 to axis 1: Q = [[c, s], [-s, c]], Q diag(a, b) Q^T
  const auto turned = [&](double a, double b, double third) {
    Vector6 t;
    t << c * c * a + s * s * b, s * s * a + c * c * b, third, std::sqrt(2.0) * c * s * (b - a), 0.0, 0.0;
    return t;
  };
  EXPECT_LE((end->state.stress - 1e3 * turned(-120.0, -90.0, -90.0)).norm(), 1e-3);
  EXPECT_LE((end->state.omega - turned(-0.2, 0.1, 0.1)).norm(), 1e-8);
}

}  // namespace
}  // namespace isotach::integrators
