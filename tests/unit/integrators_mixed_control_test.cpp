// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mixed control: strain rates found for prescribed stress rates, their derivatives, and prescribed stresses
// kept.
#include <gtest/gtest.h>

#include <random>

#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::set_a;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

TEST(LoadingRate, FindsTheStrainRateWhoseStressRateIsPrescribed) {
  const Law law(set_a(0.3));
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector6 stress = stress_kPa(120.0, 80.0, 70.0);
  stress.tail<3>() << 9e3, -14e3, 6e3;
  const State state{stress, 1.4};
  for (int controlled = 1; controlled < 64; ++controlled) {  // every choice of components
    Vector6 strain_rate;
    for (int i = 0; i < 6; ++i) strain_rate[i] = 1e-6 * uniform(generator);
    Increment<double> increment;
    increment.spin << 1e-6 * uniform(generator), 1e-6 * uniform(generator), 1e-6 * uniform(generator);
    const Vector6 stress_rate =
        law.rate(state, strain_rate).stress + model::corotation<double, 6>(stress, increment.spin);
    for (int i = 0; i < 6; ++i) {
      const bool by_stress = ((controlled >> i) & 1) != 0;
      increment.stress_controlled[static_cast<std::size_t>(i)] = by_stress;
      (by_stress ? increment.stress_rate : increment.strain_rate)[i] =
          by_stress ? stress_rate[i] : strain_rate[i];
    }
    LoadingRate<double> loading(law, increment);
    model::StateRate<double> rate;
    ASSERT_TRUE(loading(state, rate));
    // round-off of the 6x6 system, whose condition is about 1 + a^2/3 = 6
    EXPECT_LE((loading.strain_rate() - strain_rate).norm(), 1e-19) << "controlled " << controlled;
    EXPECT_LE((rate.stress - stress_rate).norm(), 1e-13 * stress_rate.norm()) << "controlled " << controlled;
  }
}

TEST(LoadingRate, OutsideTheDomainLeavesRateAndStrainRateAsTheyWere) {
  const Law law(set_a());
  Increment<double> increment;
  increment.stress_controlled.fill(true);
  LoadingRate<double> loading(law, increment);
  model::StateRate<double> rate;
  ASSERT_TRUE(loading({stress_kPa(100.0, 100.0, 100.0), 1.5}, rate));
  const Vector6 strain_rate = loading.strain_rate();
  const Vector6 stress_rate = rate.stress;
  EXPECT_FALSE(loading({stress_kPa(-1.0, 0.0, 0.0), 1.5}, rate));
  EXPECT_FALSE(loading({stress_kPa(100.0, 100.0, 100.0), std::nan("")}, rate));
  EXPECT_EQ(loading.strain_rate(), strain_rate);
  EXPECT_EQ(rate.stress, stress_rate);
}

TEST(LoadingRate, JetsCarryTheDerivativesOfTheStrainRateEvenWhereItsValueIsZero) {
  // Creep at isotropic stress, OCR = 1: D = m D_r, and for a small deviator m' = 3 sqrt3 T*/(M^2 p), while
  // along p |D_vis| grows with the power 1/I_v and with e as p_B falls.
  using Jet = ceres::Jet<double, 7>;
  const model::Law<Jet> law(set_a().cast<Jet>());
  Increment<Jet> hold;
  hold.stress_controlled.fill(true);
  LoadingRate<Jet> loading(law, hold);
  model::State<Jet> state;
  for (int i = 0; i < 6; ++i) state.stress[i] = Jet(i < 3 ? -100e3 : 0.0, i);
  state.void_ratio = Jet(1.5, 6);
  model::StateRate<Jet> rate;
  for (int call = 0; call < 3; ++call) {  // later calls start from the strain rate of the one before
    ASSERT_TRUE(loading(state, rate));
    const double M = 0.9838315888;
    const double shear = 1e-6 * 3.0 * std::numbers::sqrt3 / (M * M * 100e3);
    for (int i = 3; i < 6; ++i) {
      EXPECT_EQ(loading.strain_rate()[i].a, 0.0);
      EXPECT_NEAR(loading.strain_rate()[i].v[i] / shear, 1.0, 1e-9);
      EXPECT_NEAR(rate.stress[i].v[i], 0.0, 1e-15);
    }
    const double axial = -1e-6 / std::numbers::sqrt3;
    EXPECT_NEAR(loading.strain_rate()[0].a / axial, 1.0, 1e-13);
    const double along_p = -100e3 * loading.strain_rate()[0].v.head<3>().sum();
    EXPECT_NEAR(along_p / axial, 20.0, 1e-11);
    EXPECT_NEAR(loading.strain_rate()[0].v[6] * 2.5 * 0.1 / axial, 20.0, 1e-11);
  }
}

TEST(LoadingRate, DerivativesOfPrescribedStressRatesVanishToRoundOffFromAnyStart) {
  using Jet = ceres::Jet<double, 7>;
  const model::Law<Jet> law(set_a(0.3).cast<Jet>());
  Increment<Jet> increment;
  increment.strain_rate[0] = Jet(-1e-6);
  increment.stress_controlled = {false, true, true, true, true, true};
  LoadingRate<Jet> loading(law, increment);
  // far from the start value zero, then a hair away from the last: one Newton step would leave 1e-9 of the
  // derivatives
  for (const double factor : {1.0, 1.0 + 1e-9, 1.5}) {
    model::State<Jet> state;
    const Vector6 stress = factor * stress_kPa(120.0, 80.0, 70.0);
    for (int i = 0; i < 6; ++i) state.stress[i] = Jet(stress[i] + (i == 4 ? 9e3 : 0.0), i);
    state.void_ratio = Jet(1.4, 6);
    model::StateRate<Jet> rate;
    ASSERT_TRUE(loading(state, rate));
    model::Mandel<Jet> held = loading.strain_rate();
    for (int i = 0; i < 6; ++i) held[i].v.setZero();
    const auto at_held_strain_rate = law.rate(state, held);
    for (int i = 1; i < 6; ++i) {
      for (int j = 0; j < 7; ++j) {
        EXPECT_NEAR(rate.stress[i].v[j], 0.0,
                    1e-13 * std::abs(at_held_strain_rate.stress[1].v.cwiseAbs()[j]) + 1e-17);
      }
    }
  }
}

class MixedControl : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(EveryIntegrator, MixedControl, testing::ValuesIn(kMethods),
                         [](const auto& method) { return tests::test_name(method.param); });

TEST_P(MixedControl, ReachesThePrescribedStressesAndStrains) {
  const Law law(set_a(0.1));
  const State start{stress_kPa(100.0, 100.0, 100.0), 1.4};
  Increment<double> increment;
  increment.duration = 3e4;
  increment.strain_rate << -1e-6, 0.0, 0.0, 0.0, 2e-7, 0.0;
  increment.stress_rate << 0.0, -0.5, 0.3, 0.1, 0.0, -0.2;
  increment.stress_controlled = {false, true, true, true, false, true};
  Options options;  // default tolerances: what is prescribed does not depend on them
  options.method = GetParam();
  const auto end = integrate(law, start, increment, options).value();
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    if (increment.stress_controlled[static_cast<std::size_t>(i)]) {
      EXPECT_NEAR(end.state.stress[i], start.stress[i] + 3e4 * increment.stress_rate[i], 1e-12 * 100e3);
      EXPECT_NE(end.strain[i], 0.0);
    } else {
      EXPECT_NEAR(end.strain[i], 3e4 * increment.strain_rate[i], 1e-14);
    }
  }
}

TEST_P(MixedControl, StressRatesAreThoseInFixedAxesUnderSpin) {
  const Law law(set_a(0.1));
  const State start{stress_kPa(100.0, 70.0, 80.0), 1.4};
  Increment<double> increment;
  increment.duration = 1e5;
  increment.spin << 2e-6, -1e-6, 3e-6;
  increment.stress_rate << -0.1, 0.0, 0.05, 0.02, 0.0, -0.03;
  increment.stress_controlled.fill(true);
  Options options;
  options.method = GetParam();
  const auto end = integrate(law, start, increment, options).value();
  EXPECT_LE((end.state.stress - start.stress - 1e5 * increment.stress_rate).norm(), 1e-12 * 100e3);
}

TEST_P(MixedControl, SpinAloneTurnsStress) {
  // no creep (e = 0.2), D = 0, constant W12: the stress is R T R^T with the rotation by W12 t
  const Law law(set_a());
  const State start{stress_kPa(130.0, 80.0, 90.0), 0.2};
  Increment<double> increment;
  increment.duration = 1.0;
  increment.spin[0] = 0.7;
  const auto end = integrate(law, start, increment, tests::tight(GetParam())).value();
  Eigen::Matrix3d w = Eigen::Matrix3d::Zero();
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  w << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;  // exp(W t), W = [[0, w], [-w, 0]]
  const Eigen::Matrix3d expected = w * model::matrix_from_mandel<double, 6>(start.stress) * w.transpose();
  EXPECT_LE((model::matrix_from_mandel<double, 6>(end.state.stress) - expected).norm(),
            1e-9 * expected.norm());
}

TEST_P(MixedControl, UnloadingTowardsZeroPressureFollowsTheSwellingLine) {
  // p falls from 100 kPa to 10 Pa; without creep (e = 0.2) 1 + e = 1.2 (p0/p)^kappa
  const Law law(set_a());
  Increment<double> unload;
  unload.duration = 99.99;
  unload.stress_rate.head<3>().setConstant(1e3);
  unload.stress_controlled.fill(true);
  const auto end =
      integrate(law, {stress_kPa(100.0, 100.0, 100.0), 0.2}, unload, tests::tight(GetParam())).value();
  // some 1e5 substeps of 1 Pa or less, each rounded to 1e-11 Pa; a relative 1e-7 of p is 2e-9 of p^kappa
  EXPECT_NEAR(tests::p_kPa(end.state), 0.01, 1e-9);
  EXPECT_NEAR(1.0 + end.state.void_ratio, 1.2 * std::pow(1e4, 0.02), 1e-8);
}

TEST_P(MixedControl, OedometerWithLateralStrainFixedEqualsStrainDriven) {
  // stress control along axis 1 with the stress rate that a strain-driven step needs on average ends at its
  // strain
  const Law law(set_a(0.1));
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.4};
  Increment<double> by_stress;
  by_stress.duration = 2e4;
  by_stress.stress_rate[0] = -1.0;
  by_stress.stress_controlled[0] = true;
  const auto end = integrate(law, start, by_stress, tests::tight(GetParam())).value();
  EXPECT_NEAR(end.state.stress[0], -120e3, 1e-7);
  EXPECT_EQ(end.strain[1], 0.0);
  EXPECT_EQ(end.strain[2], 0.0);
  // axial and volumetric strain are one: 1 + e = 2.4 exp(eps)
  EXPECT_NEAR(1.0 + end.state.void_ratio, 2.4 * std::exp(end.strain[0]), 1e-9);
  EXPECT_LT(end.strain[0], 0.0);
}

}  // namespace
}  // namespace isotach::integrators
