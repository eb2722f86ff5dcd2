// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The inclined ellipse and the rotation of Omega: what switching it off leaves, geometry, objectivity,
// limits.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "model/law.hpp"
#include "tests/set_a.hpp"

namespace isotach::model {
namespace {

using tests::set_a_values;
using tests::stress_kPa;
using tests::Vector6;
using Inclined = State<double>;
using Upright = State<double, kGeneral, Fabric::none>;

Parameters<double> rotating_set(double C_1, double C_2, double C_3,
                                LodeDependence lode = LodeDependence::matsuoka_nakai) {
  auto values = set_a_values();
  values.lode = lode;
  values[ParameterId::C_1] = C_1;
  values[ParameterId::C_2] = C_2;
  values[ParameterId::C_3] = C_3;
  return Parameters<double>::create(values).value();
}

class Anisotropy : public testing::Test {
 protected:
  std::mt19937_64 random_{20260301};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};

  /// p of 100 kPa or so, |T*|/p up to about 0.5.
  [[nodiscard]] Vector6 stress() {
    Vector6 t = tensor() * 20e3;
    t.head<3>().array() -= 100e3 * (1.0 + 0.3 * unit_(random_));
    return t;
  }
  [[nodiscard]] Vector6 tensor() {
    Vector6 a;
    for (int i = 0; i < 6; ++i) a[i] = unit_(random_);
    return a;
  }
  /// Deviatoric, norm up to about 0.4: (3/2) Omega:Omega stays below M^2 of set A in every direction.
  [[nodiscard]] Vector6 omega() { return deviator<double, 6>(tensor()) * 0.15; }
};

TEST_F(Anisotropy, SwitchedOffGivesTheSameRates) {
  // to round-off: the compiler may contract products and sums of the two forms differently; integrators
  // choose the form, so that their results are the same to the last bit (integrators_forms_test)
  const Law<double> law(rotating_set(0.1, 0.0, 0.0));
  for (int i = 0; i < 1000; ++i) {
    const Vector6 t = stress();
    const Vector6 d = tensor() * 1e-6;
    const auto inclined = law.rate(Inclined{t, 1.4}, d);
    const auto upright = law.rate(Upright{t, 1.4}, d);
    EXPECT_LE((inclined.stress - upright.stress).norm(), 2e-14 * upright.stress.norm());
    EXPECT_EQ(inclined.void_ratio, upright.void_ratio);
    EXPECT_TRUE(law.stays_upright(Inclined{t, 1.4}));
    EXPECT_EQ(inclined.omega, Vector6::Zero());
  }
}

TEST_F(Anisotropy, EllipseThroughItsTipHasTheSizeOfItsPressure) {
  // where T* = p Omega the ellipse's axis meets the stress: p_B+ = p
  const Law<double> law(rotating_set(0.0, 0.0, 0.0));
  for (int i = 0; i < 20; ++i) {
    Inclined state{stress_kPa(80.0, 80.0, 80.0), 1.4, omega()};
    state.stress += 80e3 * state.omega;
    EXPECT_NEAR(law.measures(state).equivalent_pressure, 80e3, 1e-9);
  }
}

TEST_F(Anisotropy, FlowIsNormalToTheEllipseWhereMIsConstant) {
  // m along d p_B+/dT by automatic differentiation of p_B+; M does not vary without Lode dependence
  using Jet = ceres::Jet<double, 6>;
  const Law<double> law(rotating_set(0.0, 0.0, 0.0, LodeDependence::none));
  for (int i = 0; i < 50; ++i) {
    const Inclined state{stress(), 1.4, omega()};
    State<Jet> jets = cast<Jet>(state);
    for (int j = 0; j < 6; ++j) jets.stress[j].v[j] = 1.0;
    const Vector6 gradient = law.measures(jets).equivalent_pressure.v;
    EXPECT_LE((law.measures(state).m - gradient.normalized()).norm(), 1e-14);
  }
}

TEST_F(Anisotropy, SizeOfTheEllipseIsHomogeneousOfDegreeOneInStress) {
  const Law<double> law(rotating_set(0.0, 0.0, 0.0));
  for (int i = 0; i < 20; ++i) {
    const Inclined state{stress(), 1.4, omega()};
    const Inclined twice{2.0 * state.stress, 1.4, state.omega};
    const auto at = law.measures(state);
    EXPECT_NEAR(law.measures(twice).equivalent_pressure, 2.0 * at.equivalent_pressure,
                1e-15 * at.equivalent_pressure);
    EXPECT_LE((law.measures(twice).m - at.m).norm(), 1e-15);
  }
}

TEST_F(Anisotropy, RatesTurnWithStressStrainRateAndOmega) {
  const Law<double> law(rotating_set(0.1, 40.0, 0.5));
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d Q =
        Eigen::Quaterniond(unit_(random_), unit_(random_), unit_(random_), unit_(random_))
            .normalized()
            .matrix();
    const auto turned = [&Q](const Vector6& a) {
      return Vector6(mandel_from_matrix<double>(Q * matrix_from_mandel<double, 6>(a) * Q.transpose()));
    };
    const Inclined state{stress(), 1.5, omega()};
    const Vector6 d = tensor() * 1e-6;
    const auto rate = law.rate(state, d);
    const auto rate_turned = law.rate(Inclined{turned(state.stress), 1.5, turned(state.omega)}, turned(d));
    EXPECT_LE((rate_turned.stress - turned(rate.stress)).norm(), 1e-12 * rate.stress.norm());
    EXPECT_LE((rate_turned.omega - turned(rate.omega)).norm(), 1e-12 * rate.omega.norm());
  }
}

TEST_F(Anisotropy, OmegaStaysDeviatoric) {
  const Law<double> law(rotating_set(0.1, 40.0, 0.5));
  for (int i = 0; i < 50; ++i) {
    const auto rate = law.rate(Inclined{stress(), 1.5, omega()}, Vector6(tensor() * 1e-6));
    EXPECT_NEAR((trace<double, 6>(rate.omega)), 0.0, 1e-14 * rate.omega.norm());
  }
}

TEST_F(Anisotropy, RotationRateVanishesAtItsAttractorAndWithoutFlow) {
  const Vector6 ratio = deviator<double, 6>(tensor());
  EXPECT_EQ((rotation_rate<double, double, 6>(40.0, 0.5, ratio, ratio * 0.5, 1e-6)), Vector6::Zero());
  EXPECT_EQ((rotation_rate<double, double, 6>(40.0, 0.5, ratio, Vector6::Zero(), 0.0)), Vector6::Zero());
  const Vector6 rate = rotation_rate<double, double, 6>(40.0, 0.5, ratio, Vector6::Zero(), 2e-6);
  EXPECT_LE((rate - 40.0 * 0.5 * 2e-6 * ratio).norm(), 1e-20);
}

TEST_F(Anisotropy, DomainEndsWhereTheEllipseDoes) {
  // (3/2) Omega:Omega < M^2, M of the stress's Lode angle: in triaxial compression that of set A, 0.98383
  const Law<double> law(rotating_set(0.0, 0.0, 0.0));
  const double M = law.critical_ratio();
  const auto inside = [&](const Vector6& t, double q_of_omega) {
    Inclined state{t, 1.5};
    state.omega.head<3>() << -2.0 * q_of_omega / 3.0, q_of_omega / 3.0, q_of_omega / 3.0;
    return law.in_domain(state);
  };
  const Vector6 compression = stress_kPa(120.0, 90.0, 90.0);
  EXPECT_TRUE(inside(compression, M - 1e-9));
  EXPECT_FALSE(inside(compression, M + 1e-9));
  // F = 1 - |q|/(3p) in extension: here |q|/p = 0.3
  const Vector6 extension = stress_kPa(80.0, 110.0, 110.0);
  EXPECT_TRUE(inside(extension, 0.9 * M - 1e-9));
  EXPECT_FALSE(inside(extension, 0.9 * M + 1e-9));
  EXPECT_FALSE(inside(compression, std::nan("")));
}

}  // namespace
}  // namespace isotach::model
