// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Steady oedometric compression: against the law itself, long integrations, and finite differences.
#include <gtest/gtest.h>

#include <array>

#include "integrators/steady_oedometric.hpp"
#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using model::ParameterId;
using tests::compression_rate;
using tests::Law;
using tests::set_a;
using tests::set_a_values;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

constexpr double kRate = 1e-6;  // 1/s

/// A state on the steady branch at void ratio e: OCR = (|D_vis|/D_r)^(-I_v) sets its size.
State on_branch(const Law& law, const SteadyOedometric<double>& steady, double e) {
  const Vector6 shape = stress_kPa(1.0, steady.K0, steady.K0);
  const double equivalent = law.measures(shape).equivalent_pressure;
  const double ocr = std::pow(steady.viscous_rate / law.parameters().D_r(), -law.parameters().I_v());
  return {shape * (law.preconsolidation_pressure(e) / (ocr * equivalent)), e};
}

TEST(SteadyOedometric, StressesGrowAsPreconsolidationPressure) {
  // dT/dt = T r/lambda and d(1+e)/dt = -(1+e) r, checked with the law's own rate
  auto values = set_a_values();
  for (const auto lode : {model::LodeDependence::matsuoka_nakai, model::LodeDependence::none}) {
    for (const double phi_deg : {5.0, 14.2, 25.0, 45.0, 70.0}) {
      for (const double kappa : {0.0005, 0.0129, 0.06, 0.095}) {
        for (const double part : {0.0, 0.2, 0.8}) {  // of the largest admissible C_1
          values.lode = lode;
          values[ParameterId::phi_c] = phi_deg * std::numbers::pi / 180.0;
          values[ParameterId::kappa] = kappa;
          values[ParameterId::C_1] = part * (1.0 - kappa / 0.1);
          const Law law(model::Parameters<double>::create(values).value());
          const auto steady = steady_oedometric(law.parameters(), kRate);
          ASSERT_TRUE(steady) << steady.error();
          EXPECT_GT(steady->K0, 0.0);
          EXPECT_LT(steady->K0, 1.0);
          EXPECT_GT(steady->viscous_rate, 0.0);
          const State state = on_branch(law, *steady, 1.2);
          const Vector6 strain_rate = compression_rate(kRate, 0.0, 0.0);
          const auto rate = law.rate(state, strain_rate);
          // E : D and E : (D_vis + D_Hp) cancel but for a small part, so round-off is measured by the former;
          // the power 1/I_v of a pressure ratio, by way of logarithms near 11, makes some 200 epsilons of it
          const double terms = law.stiffness_times(law.measures(state.stress), strain_rate).norm();
          EXPECT_LE((rate.stress - state.stress * (kRate / 0.1)).norm(), 1e-13 * terms)
              << phi_deg << " deg, kappa " << kappa << ", C_1 " << values[ParameterId::C_1];
        }
      }
    }
  }
}

TEST(SteadyOedometric, IsWhereLongConstantRateCompressionEnds) {
  for (const double C_1 : {0.0, 0.1}) {
    const Law law(set_a(C_1));
    const auto steady = steady_oedometric(law.parameters(), kRate).value();
    for (const Method method : {Method::fellin_ostermann, Method::cvode}) {
      // strain 0.6: K0 misses its limit by 3e-7 at 0.2 and by 4e-10 at 0.3
      const State end = tests::strained(law, {stress_kPa(100.0, 65.0, 65.0), 1.5},
                                        compression_rate(kRate, 0.0, 0.0), 0.6 / kRate, tests::tight(method));
      EXPECT_NEAR(end.stress[1] / end.stress[0], steady.K0, 2e-10);
      const State expected = on_branch(law, steady, end.void_ratio);
      EXPECT_LE((end.stress - expected.stress).norm(), 5e-10 * expected.stress.norm());
    }
  }
}

TEST(SteadyOedometric, K0OfSetAIsNearTheTabulatedTransient) {
  // the table's row ends at strain 0.2, 3e-7 short of the steady state
  EXPECT_NEAR(steady_oedometric(set_a(), kRate).value().K0, 0.72005924, 4e-7);
}

TEST(SteadyOedometric, ViscousRateIsProportionalToTheRateAndK0IndependentOfIt) {
  const auto slow = steady_oedometric(set_a(0.1), 1e-8).value();
  const auto fast = steady_oedometric(set_a(0.1), 1e-3).value();
  EXPECT_EQ(slow.K0, fast.K0);
  EXPECT_NEAR(fast.viscous_rate / slow.viscous_rate, 1e5, 1e-9);
}

TEST(SteadyOedometric, JetsMatchFiniteDifferences) {
  using Jet = ceres::Jet<double, static_cast<int>(model::kParameterCount)>;
  const auto base = set_a(0.1).values();
  model::ParameterValues<Jet> values;
  for (std::size_t i = 0; i < model::kParameterCount; ++i)
    values.values[i] = Jet(base.values[i], static_cast<int>(i));
  const auto steady = steady_oedometric(model::Parameters<Jet>::create(values).value(), kRate).value();
  const auto plain = steady_oedometric(set_a(0.1), kRate).value();
  EXPECT_NEAR(steady.K0.a, plain.K0, 1e-15);
  for (std::size_t i = 0; i < model::kParameterCount; ++i) {
    SCOPED_TRACE(model::kParameterTable[i].name);
    const auto at = [&](double h) {
      auto moved = base;
      moved.values[i] *= 1.0 + h;
      return steady_oedometric(model::Parameters<double>::create(moved).value(), kRate).value();
    };
    const double h = 1e-4;  // truncation of the central difference ~ h^2, round-off ~ 1e-15/h
    const double K0 = (at(h).K0 - at(-h).K0) / (2.0 * h);
    const double rate = (at(h).viscous_rate - at(-h).viscous_rate) / (2.0 * h);
    const int j = static_cast<int>(i);
    EXPECT_NEAR(steady.K0.v[j] * base.values[i], K0, 2e-8);
    EXPECT_NEAR(steady.viscous_rate.v[j] * base.values[i] / kRate, rate / kRate, 2e-8);
  }
  // e100, I_v and D_r do not enter
  for (const ParameterId id : {ParameterId::e100, ParameterId::I_v, ParameterId::D_r}) {
    EXPECT_EQ(steady.K0.v[static_cast<int>(id)], 0.0);
    EXPECT_EQ(steady.viscous_rate.v[static_cast<int>(id)], 0.0);
  }
}

TEST(SteadyOedometric, AxialRateMustBePositiveAndFinite) {
  for (const double rate : {0.0, -1e-6, std::nan(""), static_cast<double>(HUGE_VAL)}) {
    const auto steady = steady_oedometric(set_a(), rate);
    ASSERT_FALSE(steady);
    EXPECT_NE(steady.error().find("accepted: > 0 and finite"), std::string::npos);
  }
}

}  // namespace
}  // namespace isotach::integrators
