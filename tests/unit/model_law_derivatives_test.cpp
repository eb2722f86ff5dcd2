// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Exact derivatives of the law by ceres::Jet against central finite differences, and where they could break.
#include <gtest/gtest.h>

#include <array>

#include "model/law.hpp"
#include "tests/set_a.hpp"

namespace isotach::model {
namespace {

using tests::compression_rate;
using tests::set_a_values;
using tests::stress_kPa;
using tests::Vector6;

// Inputs: six stresses, e, six strain rates, the parameters, six components of Omega.
constexpr int kOmega = 6 + 1 + 6 + static_cast<int>(kParameterCount);
constexpr int kInputs = kOmega + 6;
using Jet = ceres::Jet<double, kInputs>;
using Inputs = Eigen::Matrix<double, kInputs, 1>;
constexpr std::size_t kOutputs = 13;  // rates of stress, e and Omega

template <class S>
std::array<S, kOutputs> evaluate(const Eigen::Matrix<S, kInputs, 1>& x, LodeDependence lode) {
  ParameterValues<S> values;
  values.lode = lode;
  for (std::size_t i = 0; i < kParameterCount; ++i) values.values[i] = x[13 + static_cast<int>(i)];
  const Law<S> law(Parameters<S>::create(values).value());
  const Mandel<S> stress = x.template head<6>();
  const Mandel<S> strain_rate = x.template segment<6>(7);
  const Mandel<S> omega = x.template segment<6>(kOmega);
  const auto rate = law.rate(State<S>{stress, x[6], omega}, strain_rate);
  std::array<S, kOutputs> result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = rate.stress[static_cast<int>(i)];
  result[6] = rate.void_ratio;
  for (std::size_t i = 0; i < 6; ++i) result[7 + i] = rate.omega[static_cast<int>(i)];
  return result;
}

/// Set A with C_2 = 30, C_3 = 0.4.
Inputs inputs(const Vector6& stress, const Vector6& strain_rate, double C_1,
              const Vector6& omega = Vector6::Zero()) {
  Inputs x = Inputs::Zero();
  x.head<13>() << stress, 1.4, strain_rate;
  x.tail<6>() = omega;
  for (std::size_t i = 0; i < kParameterCount; ++i) x[13 + static_cast<int>(i)] = set_a_values().values[i];
  x[13 + static_cast<int>(ParameterId::C_1)] = C_1;
  x[13 + static_cast<int>(ParameterId::C_2)] = 30.0;
  x[13 + static_cast<int>(ParameterId::C_3)] = 0.4;
  return x;
}

std::array<Jet, kOutputs> with_jets(const Inputs& x, LodeDependence lode) {
  Eigen::Matrix<Jet, kInputs, 1> jets;
  for (int i = 0; i < kInputs; ++i) jets[i] = Jet(x[i], i);
  return evaluate<Jet>(jets, lode);
}

/// Natural size of an input, for the finite difference's step.
double scale(int i) {
  if (i < 6) return 100e3;
  if (i == 6) return 1.0;
  if (i < 13) return 1e-6;
  if (i >= kOmega) return 1.0;
  const double value = set_a_values().values[static_cast<std::size_t>(i - 13)];
  return value > 0.0 ? value : 0.1;
}

void expect_jets_match_differences(const Inputs& x, LodeDependence lode) {
  const auto exact = with_jets(x, lode);
  const double size = std::abs(exact[0].a) + std::abs(exact[1].a) + std::abs(exact[3].a);
  for (int j = 0; j < kInputs; ++j) {
    // Richardson's extrapolation of central differences; the power 1/I_v = 20 makes the higher derivatives
    // large
    const auto difference = [&](double h, std::size_t i) {
      Inputs up = x;
      Inputs down = x;
      up[j] += h;
      down[j] -= h;
      return (evaluate<double>(up, lode)[i] - evaluate<double>(down, lode)[i]) / (2.0 * h);
    };
    const double h = 4e-4 * scale(j);
    for (std::size_t i = 0; i < kOutputs; ++i) {
      const double numeric = (4.0 * difference(h / 2, i) - difference(h, i)) / 3.0;
      const double out = i < 6 ? size : 1e-6;
      // truncation ~ (20 h)^4 and round-off ~ 1e-16/h, both below 1e-8 in units of output/input
      EXPECT_NEAR(exact[i].v[j] * scale(j) / out, numeric * scale(j) / out, 3e-7)
          << "output " << i << " input " << j;
    }
  }
}

TEST(LawDerivatives, JetsMatchFiniteDifferencesAtAGeneralState) {
  Vector6 stress = stress_kPa(120.0, 80.0, 70.0);
  stress.tail<3>() << 9e3, -14e3, 6e3;
  Vector6 strain_rate = compression_rate(1e-6, -3e-7, 2e-7);
  strain_rate.tail<3>() << 4e-7, 1e-7, -5e-7;
  for (const auto lode : {LodeDependence::matsuoka_nakai, LodeDependence::none}) {
    expect_jets_match_differences(inputs(stress, strain_rate, 0.1), lode);
  }
}

TEST(LawDerivatives, JetsMatchFiniteDifferencesWhereTheEllipseIsInclined) {
  Vector6 stress = stress_kPa(120.0, 80.0, 70.0);
  stress.tail<3>() << 9e3, -14e3, 6e3;
  Vector6 omega;
  omega << -0.2, 0.15, 0.05, 0.1, -0.07, 0.12;
  for (const auto lode : {LodeDependence::matsuoka_nakai, LodeDependence::none}) {
    expect_jets_match_differences(inputs(stress, compression_rate(1e-6, -3e-7, 2e-7), 0.1, omega), lode);
  }
}

TEST(LawDerivatives, JetsMatchFiniteDifferencesInExtension) {
  const Vector6 stress = stress_kPa(70.0, 110.0, 115.0);
  expect_jets_match_differences(inputs(stress, compression_rate(-1e-6, 3e-7, 2e-7), 0.2),
                                LodeDependence::matsuoka_nakai);
}

TEST(LawDerivatives, StayFiniteAtIsotropicStressAndAtRest) {
  for (const double p : {100.0, 99.7, 1e-3 / 3.0}) {  // 3p rounds differently in each
    for (const Vector6& strain_rate : {Vector6(Vector6::Zero()), compression_rate(1e-6, 1e-6, 1e-6)}) {
      for (const auto& output :
           with_jets(inputs(stress_kPa(p, p, p), strain_rate, 0.1), LodeDependence::matsuoka_nakai)) {
        EXPECT_TRUE(std::isfinite(output.a));
        EXPECT_TRUE(output.v.allFinite());
      }
    }
  }
}

TEST(LawDerivatives, OfVolumetricResponseAreRightAtIsotropicStress) {
  // dp/dt = -(p/kappa)(sqrt3 D_r (p/p_B)^(1/I_v)) at rest and C_1 = 0, so d ln(-dp/dt)/d ln p = 1 + 1/I_v
  const auto output = with_jets(inputs(stress_kPa(100.0, 100.0, 100.0), Vector6::Zero(), 0.0),
                                LodeDependence::matsuoka_nakai);
  const double along_p = output[0].v.head<3>().sum() * -100e3;
  EXPECT_NEAR(along_p / output[0].a, 21.0, 1e-12);
}

TEST(LawDerivatives, GuardOfTheRootsCostsNoAccuracy) {
  // at |T*|/p of 1e-6, 1e-9 and 1e-12 the Lode factor in extension still is 1 - q/(3p), to round-off of 1
  const Law<double> law(Parameters<double>::create(set_a_values()).value());
  for (const double q : {1e-4, 1e-7, 1e-10}) {  // kPa at p = 100 kPa
    const auto at = law.measures(stress_kPa(100.0 - 2 * q / 3, 100.0 + q / 3, 100.0 + q / 3));
    EXPECT_NEAR(at.F, 1.0 - q / 300.0, 4e-16);
  }
  // |D| down to 1e-30 /s: the hypoplastic part is still C_1 |D|, seen where creep is nil
  auto values = set_a_values();
  values[ParameterId::C_1] = 0.5;
  const Law<double> hypoplastic(Parameters<double>::create(values).value());
  for (const double r : {1e-6, 1e-30}) {
    const auto rate = hypoplastic.rate(tests::State{stress_kPa(100.0, 100.0, 100.0), 0.01},
                                       compression_rate(r / 3, r / 3, r / 3));
    EXPECT_NEAR(-rate.stress[0] / r / (100e3 / 0.02), 0.5, 1e-14);
  }
}

}  // namespace
}  // namespace isotach::model
