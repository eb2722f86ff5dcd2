// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The law: its invariances, its flow direction, its Lode factor, and its domain.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "model/law.hpp"
#include "tests/set_a.hpp"

namespace isotach::model {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::set_a;
using tests::set_a_values;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

/// Seeded stresses around p = 100 kPa with q < 1.2 p, about as far out as M = 0.98 lets clay come.
class RandomStates : public testing::Test {
 protected:
  Vector6 tensor() {
    Vector6 a;
    for (int i = 0; i < 6; ++i) a[i] = uniform_(generator_);
    return a;
  }
  Vector6 stress() {
    const Vector6 dev = deviator<double, 6>(tensor());
    const double q = 120e3 * std::abs(uniform_(generator_));
    return dev * (q / (std::sqrt(1.5) * dev.norm())) - 100e3 * unit_tensor<double>();
  }
  Eigen::Matrix3d rotation() {
    Eigen::Quaterniond r(uniform_(generator_), uniform_(generator_), uniform_(generator_),
                         uniform_(generator_));
    return r.normalized().toRotationMatrix();
  }

 private:
  std::mt19937 generator_{7};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

using LawProperties = RandomStates;

Law law_without_lode_dependence() {
  auto values = set_a_values();
  values.lode = LodeDependence::none;
  return Law(Parameters<double>::create(values).value());
}

TEST_F(LawProperties, FlowDirectionHasUnitNorm) {
  const Law law(set_a());
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(law.measures(stress()).m.norm(), 1.0, 1e-15);
}

TEST_F(LawProperties, FlowDirectionIsOutwardGradientOfEllipseAtFixedCriticalRatio) {
  const Law law(set_a());
  for (int i = 0; i < 50; ++i) {
    const Vector6 t = stress();
    const auto at = law.measures(t);
    const double M = at.F * law.critical_ratio();
    // the ellipse as the zero of p^2 + q^2/M^2 - p p_B+, M and p_B+ held
    const auto ellipse = [&](const Vector6& x) {
      const double p = -trace<double, 6>(x) / 3.0;
      return p * p + 1.5 * deviator<double, 6>(x).squaredNorm() / (M * M) - p * at.equivalent_pressure;
    };
    Vector6 gradient;
    for (int j = 0; j < 6; ++j) {
      Vector6 step = Vector6::Zero();
      step[j] = 100.0;  // Pa; central differences of a quadratic have no truncation error
      gradient[j] = ellipse(t + step) - ellipse(t - step);
    }
    EXPECT_LE((gradient.normalized() - at.m).norm(), 1e-9);
  }
}

TEST_F(LawProperties, FlowDirectionAtIsotropicStressIsIsotropicCompression) {
  const Vector6 expected = unit_tensor<double>() / -std::numbers::sqrt3;
  EXPECT_LE((Law(set_a()).measures(stress_kPa(100.0, 100.0, 100.0)).m - expected).norm(), 1e-15);
}

TEST(LodeFactor, IsOneInTriaxialCompressionAndOneMinusQOver3pInExtension) {
  const Law law(set_a());
  for (const double q : {1e-6, 1.0, 50.0, 98.0, 140.0}) {  // kPa at p = 100 kPa
    const auto compression = law.measures(stress_kPa(100.0 + 2 * q / 3, 100.0 - q / 3, 100.0 - q / 3));
    EXPECT_NEAR(compression.F, 1.0, 1e-14);
    const auto extension = law.measures(stress_kPa(100.0 - 2 * q / 3, 100.0 + q / 3, 100.0 + q / 3));
    EXPECT_NEAR(extension.F, 1.0 - q / 300.0, 1e-14);
    EXPECT_EQ(law_without_lode_dependence().measures(stress_kPa(100.0 - q, 100.0, 100.0)).F, 1.0);
  }
}

TEST(LodeFactor, CriticalStressesMobiliseTheFrictionAngleAtEveryLodeAngle) {
  // Matsuoka-Nakai: I1 I2/I3 = (9 - sin^2 phi)/(1 - sin^2 phi) wherever q = F M_c p
  const Law law(set_a());
  const double sin2 = std::pow(std::sin(25.0 * std::numbers::pi / 180.0), 2);
  for (int i = 0; i <= 12; ++i) {
    const double angle = i * std::numbers::pi / 12.0;
    Eigen::Vector3d direction;
    for (int k = 0; k < 3; ++k) direction[k] = std::cos(angle - 2.0 * std::numbers::pi * k / 3.0);
    const auto stress = [&](double q) {
      const Eigen::Vector3d s = Eigen::Vector3d::Constant(100.0) + direction * (q * 2.0 / 3.0);
      return stress_kPa(s[0], s[1], s[2]);
    };
    double low = 0.0;
    double high = 150.0;
    for (int k = 0; k < 60; ++k) {
      const double q = 0.5 * (low + high);
      (q < law.measures(stress(q)).F * law.critical_ratio() * 100.0 ? low : high) = q;
    }
    const Eigen::Vector3d s = stress(low).head<3>();
    const double invariants = s.sum() * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) / s.prod();
    EXPECT_NEAR(invariants, (9.0 - sin2) / (1.0 - sin2), 1e-11);
  }
}

TEST_F(LawProperties, StiffnessIsHomogeneousOfDegreeOneInStress) {
  const Law law(set_a());
  for (int i = 0; i < 20; ++i) {
    const Vector6 t = stress();
    const Vector6 x = tensor();
    const Vector6 once = law.stiffness_times(law.measures(t), x);
    const Vector6 thrice = law.stiffness_times(law.measures(Vector6(3.0 * t)), x);
    EXPECT_LE((thrice - 3.0 * once).norm(), 1e-14 * thrice.norm());
  }
}

TEST_F(LawProperties, StiffnessIsSymmetric) {
  const Law law(set_a());
  for (int i = 0; i < 20; ++i) {
    const auto at = law.measures(stress());
    const Vector6 x = tensor();
    const Vector6 y = tensor();
    const double scale = law.stiffness_times(at, x).norm() * y.norm();
    EXPECT_NEAR(y.dot(law.stiffness_times(at, x)), x.dot(law.stiffness_times(at, y)), 4e-15 * scale);
  }
}

TEST_F(LawProperties, RateTurnsWithTheAxes) {
  const Law law(set_a(0.2));
  for (int i = 0; i < 20; ++i) {
    const State state{stress(), 1.4};
    const Vector6 strain_rate = 1e-6 * tensor();
    const Eigen::Matrix3d r = rotation();
    const auto turned = [&](const Vector6& a) {
      return mandel_from_matrix<double>(r * matrix_from_mandel<double, 6>(a) * r.transpose());
    };
    const auto rate = law.rate(state, strain_rate);
    const auto rate_turned = law.rate(State{turned(state.stress), 1.4}, turned(strain_rate));
    EXPECT_LE((rate_turned.stress - turned(rate.stress)).norm(), 1e-12 * rate.stress.norm());
    EXPECT_NEAR(rate_turned.void_ratio, rate.void_ratio, 1e-20);
  }
}

TEST_F(LawProperties, FourComponentsAgreeWithSixToTheLastBits) {
  const Law law(set_a(0.2));
  for (int i = 0; i < 20; ++i) {
    Vector6 t = stress();
    Vector6 d = 1e-6 * tensor();
    t.tail<2>().setZero();
    d.tail<2>().setZero();
    const auto general = law.rate(State{t, 1.4}, d);
    const auto plane =
        law.rate(model::State<double, 4>{t.head<4>(), 1.4}, model::Mandel<double, 4>(d.head<4>()));
    // the order of additions may differ, nothing else: OCR^(1/I_v) makes some 20 round-offs of one
    EXPECT_LE((general.stress.head<4>() - plane.stress).norm(), 2e-14 * general.stress.norm());
    EXPECT_EQ((general.stress.tail<2>()), Eigen::Vector2d::Zero());
    EXPECT_EQ(general.void_ratio, plane.void_ratio);
  }
}

TEST(LawRates, AtRestStressRelaxesTowardsTheOriginAndVoidRatioStands) {
  const Law law(set_a(0.3));
  const auto rate = law.rate(State{stress_kPa(100.0, 100.0, 100.0), 1.5}, Vector6(Vector6::Zero()));
  // dp/dt = -(p/kappa) sqrt3 D_r at OCR = 1
  EXPECT_NEAR(-rate.stress[0], -(100e3 / 0.02) * std::numbers::sqrt3 * 1e-6, 1e-12);
  EXPECT_EQ(rate.void_ratio, 0.0);
}

TEST(LawRates, HypoplasticPartMakesBulkStiffnessOneMinusC1LoadingAndOnePlusC1Unloading) {
  const Law law(set_a(0.3));
  const State state{stress_kPa(100.0, 100.0, 100.0), 0.2};  // OCR > 1000: creep is nil
  for (const double r : {1e-6, 1e3}) {
    const auto loading = law.rate(state, compression_rate(r / 3, r / 3, r / 3));
    EXPECT_NEAR(-loading.stress[0] / r, (100e3 / 0.02) * 0.7, 1e-7);
    const auto unloading = law.rate(state, compression_rate(-r / 3, -r / 3, -r / 3));
    EXPECT_NEAR(unloading.stress[0] / r, (100e3 / 0.02) * 1.3, 1e-7);
    EXPECT_NEAR(loading.void_ratio, -1.2 * r, 4e-15 * r);
  }
}

TEST(LawRates, ViscousRateIsReferenceRateAtOcrOneAndFallsWithItsPower) {
  const Law law(set_a());
  EXPECT_NEAR(law.viscous_rate(100e3, 1.5), 1e-6, 1e-19);
  EXPECT_NEAR(law.viscous_rate(100e3, law.void_ratio_at(130e3)), 1e-6 * std::pow(1.3, -20.0), 1e-19);
  EXPECT_NEAR(law.overconsolidation_ratio(State{stress_kPa(50.0, 50.0, 50.0), 1.5}), 2.0, 1e-14);
}

TEST(LawDomain, NeedsPositivePressureQBelow3pAndPositiveVoidRatio) {
  const auto inside = [](const Vector6& stress, double e) {
    return Law(set_a()).in_domain(State{stress, e});
  };
  EXPECT_TRUE(inside(stress_kPa(100.0, 100.0, 100.0), 1.5));
  EXPECT_TRUE(inside(stress_kPa(1e-9, 1e-9, 1e-9), 1e-9));
  EXPECT_TRUE(inside(stress_kPa(299.0, 0.5, 0.5), 1.5));
  EXPECT_FALSE(inside(stress_kPa(301.0, -0.5, -0.5), 1.5));
  EXPECT_FALSE(inside(stress_kPa(-101.0, 201.0, 200.0), 1.5));
  EXPECT_FALSE(inside(stress_kPa(0.0, 0.0, 0.0), 1.5));
  EXPECT_FALSE(inside(stress_kPa(-1.0, -1.0, -1.0), 1.5));
  EXPECT_FALSE(inside(stress_kPa(100.0, 100.0, 100.0), 0.0));
  EXPECT_FALSE(inside(stress_kPa(100.0, 100.0, 100.0), std::numeric_limits<double>::infinity()));
  for (int i = 0; i < 6; ++i) {
    Vector6 t = stress_kPa(100.0, 100.0, 100.0);
    t[i] = std::nan("");
    EXPECT_FALSE(inside(t, 1.5)) << i;
  }
  EXPECT_FALSE(inside(stress_kPa(100.0, 100.0, 100.0), std::nan("")));
}

TEST(LawDomain, LodeFactorIsPositiveUpToQOf3p) {
  const Law law(set_a());
  EXPECT_GT(law.measures(stress_kPa(-99.0, 199.5, 199.5)).F, 0.0);
  EXPECT_NEAR(law.measures(stress_kPa(-100.0, 200.0, 200.0)).F, 0.0, 1e-14);
}

}  // namespace
}  // namespace isotach::model
