// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Elastic, Newtonian and Herschel-Bulkley points under given motions, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/materials/viscoplastic.hpp"
#include "tests/moving_points.hpp"

namespace isotach::mpm {
namespace {

using tests::MovingPoints;
using tests::update;

constexpr double kBulk = 3e5;   // Pa
constexpr double kShear = 2e4;  // Pa
constexpr std::size_t kPoints = 70;
const double kSqrt2 = std::sqrt(2.0);

/// Simple shear at engineering rate g without its spin.
MovingPoints shearing(double g) {
  MovingPoints points(kPoints);
  points.strain_rate[3].assign(points.spin.size(), 0.5 * g * kSqrt2);
  return points;
}
/// Shear stress tau_rz of the last point (Pa).
double tau(const MovingPoints& points) {
  return points.stress[3][kPoints - 1] / kSqrt2;
}

TEST(ViscoplasticMaterial, ElasticShearAndCompression) {
  const ViscoplasticMaterial material({kBulk, kShear});
  MovingPoints points = shearing(0.02);
  for (auto& d : {0, 1, 2}) points.strain_rate[static_cast<std::size_t>(d)].assign(points.spin.size(), -0.01);
  points.reference_pressure.assign(points.spin.size(), 100.0);
  for (int n = 0; n < 100; ++n) update(material, points, 0.01);
  EXPECT_NEAR(tau(points), kShear * 0.02, 1e-9 * kShear);
  // ln J = -0.03, to the second order in a step's strain of 3e-4
  EXPECT_NEAR(std::log1p(points.void_ratio[0]), -0.03, 1e-9);
  double pressure = 0.0;
  material.total_pressure(points, 0, 1, &pressure);
  EXPECT_NEAR(pressure, 100.0 + kBulk * 0.03, 1e-3);
  EXPECT_NEAR(material.wave_modulus(points, 0), kBulk + 4.0 / 3.0 * kShear, 1e-9);
}

TEST(ViscoplasticMaterial, StressTurnsWithTheBodyExactly) {
  const ViscoplasticMaterial material({kBulk, kShear});
  MovingPoints points(kPoints);
  points.stress[0].assign(points.spin.size(), 300.0);
  points.stress[1].assign(points.spin.size(), -300.0);
  points.spin.assign(points.spin.size(), 0.7);
  constexpr int kSteps = 10;
  for (int n = 0; n < kSteps; ++n) update(material, points, 0.1);
  // W_rz = w turns by the angle -w t: sigma_rr = 300 cos 2wt, tau = -300 sin 2wt
  EXPECT_NEAR(points.stress[0][3], 300.0 * std::cos(1.4), 1e-10);
  EXPECT_NEAR(points.stress[1][3], -300.0 * std::cos(1.4), 1e-10);
  EXPECT_NEAR(tau(points), -300.0 * std::sin(1.4), 1e-10);
}

TEST(ViscoplasticMaterial, BinghamFlowTendsToYieldStressPlusViscousStress) {
  const ViscoplasticMaterial material({kBulk, kShear, 50.0, 10.0, 1.0});
  MovingPoints points = shearing(2.0);
  for (int n = 0; n < 2000; ++n) update(material, points, 1e-4);
  EXPECT_NEAR(tau(points), 50.0 + 10.0 * 2.0, 1e-6);
}

TEST(ViscoplasticMaterial, BelowYieldItIsElastic) {
  const ViscoplasticMaterial material({kBulk, kShear, 50.0, 10.0, 1.0});
  MovingPoints points = shearing(1.0);
  update(material, points, 0.9 * 50.0 / kShear);
  EXPECT_NEAR(tau(points), 45.0, 1e-9);
}

TEST(ViscoplasticMaterial, HerschelBulkleyFlowOfAnyIndex) {
  for (const double n : {0.3, 0.5, 1.5}) {
    const ViscoplasticMaterial material({kBulk, kShear, 20.0, 15.0, n});
    MovingPoints points = shearing(3.0);
    for (int k = 0; k < 5000; ++k) update(material, points, 1e-4);
    EXPECT_NEAR(tau(points), 20.0 + 15.0 * std::pow(3.0, n), 1e-6) << "n = " << n;
  }
}

// tau' = G (g - tau/k): tau = k g (1 - exp(-G t/k)), the implicit step to first order
TEST(ViscoplasticMaterial, WithoutYieldStressItIsAMaxwellFluid) {
  const ViscoplasticMaterial material({kBulk, kShear, 0.0, 100.0, 1.0});
  const double time = 100.0 / kShear;  // one relaxation time
  const double expected = 100.0 * 0.5 * (1.0 - std::exp(-1.0));
  std::vector<double> errors;
  for (const int steps : {50, 100}) {
    MovingPoints points = shearing(0.5);
    for (int n = 0; n < steps; ++n) update(material, points, time / steps);
    errors.push_back(std::abs(tau(points) - expected));
  }
  EXPECT_LT(errors[1], 0.01 * expected);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 0.9);
  EXPECT_LT(std::log2(errors[0] / errors[1]), 1.1);
}

TEST(ViscoplasticMaterial, FlowRateSolvesItsEquation) {
  for (const double n : {0.2, 0.7, 1.0, 2.0}) {
    for (const double k : {0.0, 1e-3, 10.0, 1e4}) {
      const FlowElement material{kShear, 20.0, k, n};
      for (const double excess : {1e-6, 1.0, 1e4}) {
        const double rate = material.flow_rate(20.0 + excess, 1e-4);
        const double got = kShear * 1e-4 * rate + k * std::pow(rate, n);
        EXPECT_NEAR(got, excess, 1e-9 * excess + 1e-14) << n << ' ' << k << ' ' << excess;
      }
    }
  }
}

}  // namespace
}  // namespace isotach::mpm
