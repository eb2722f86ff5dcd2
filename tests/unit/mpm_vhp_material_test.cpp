// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Packs of points against the scalar law, without Omega: one midpoint step, substeps, and the floor of
// pressure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "integrators/fellin_ostermann.hpp"
#include "mpm/materials/vhp.hpp"
#include "tests/moving_points.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::mpm {
namespace {

using model::kPlane;
using tests::MovingPoints;
using tests::update;
using PlaneState = model::State<double, kPlane, model::Fabric::none>;
using PlaneRate = model::StateRate<double, kPlane, model::Fabric::none>;
using Vector4 = model::Mandel<double, kPlane>;

constexpr std::size_t kPoints = 37;     // no multiple of any number of lanes
constexpr double kLeastPressure = 0.5;  // Pa
constexpr double kSlumpTolerance = 3e-3;

/// A point's state and motion.
struct Point {
  PlaneState state;
  Vector4 strain_rate;
  double spin;
};

/// Shears and presses as in a slump: p' 0.3 to 0.9 kPa at e 3.891, D up to `rate` (1/s).
std::vector<Point> random_points(double rate, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Point> points(kPoints);
  for (Point& point : points) {
    const double p = 600.0 + 300.0 * unit(random);
    for (int k = 0; k < kPlane; ++k) {
      point.state.stress[k] = (k < 3 ? -p : 0.0) + 0.1 * p * unit(random);
      point.strain_rate[k] = rate * unit(random);
    }
    const double mean = (point.strain_rate[0] + point.strain_rate[1] + point.strain_rate[2]) / 3.0;
    for (int k = 0; k < 3; ++k) point.strain_rate[k] -= 0.99 * mean;  // nearly undrained
    point.state.void_ratio = 3.891 + 0.02 * unit(random);
    point.spin = rate * unit(random);
  }
  return points;
}

MovingPoints particles_of(const std::vector<Point>& points) {
  MovingPoints particles(points.size());
  for (std::size_t i = 0; i < particles.spin.size(); ++i) {
    const Point& point = points[std::min(i, points.size() - 1)];
    for (int k = 0; k < kPlane; ++k) {
      particles.stress[static_cast<std::size_t>(k)][i] = point.state.stress[k];
      particles.strain_rate[static_cast<std::size_t>(k)][i] = point.strain_rate[k];
    }
    particles.void_ratio[i] = point.state.void_ratio;
    particles.spin[i] = point.spin;
  }
  return particles;
}

Vector4 stress_of(const Particles& particles, std::size_t i) {
  return {particles.stress[0][i], particles.stress[1][i], particles.stress[2][i], particles.stress[3][i]};
}

PlaneRate rate_of(const model::Law<double>& law, const PlaneState& y, const Point& point) {
  PlaneRate rate = law.rate(y, point.strain_rate);
  rate.stress += model::corotation<double, kPlane>(y.stress, {point.spin, 0.0, 0.0});
  return rate;
}

/// y + tau F(y + tau/2 F(y)) with tau = dt/substeps, `substeps` times.
PlaneState midpoint_steps(const model::Law<double>& law, const Point& point, double dt, int substeps) {
  const double tau = dt / substeps;
  PlaneState y = point.state;
  for (int n = 0; n < substeps; ++n) {
    const PlaneRate f = rate_of(law, y, point);
    const PlaneState half{y.stress + 0.5 * tau * f.stress, y.void_ratio + 0.5 * tau * f.void_ratio};
    const PlaneRate f_half = rate_of(law, half, point);
    y.stress += tau * f_half.stress;
    y.void_ratio += tau * f_half.void_ratio;
  }
  return y;
}

/// The same increment by substeps of a relative tolerance of 1e-9.
PlaneState converged(const model::Law<double>& law, const Point& point, double dt) {
  PlaneState state = point.state;
  integrators::Tolerance tolerance;
  tolerance.relative = 1e-9;
  double first = 0.0;
  const auto done = integrators::fellin_ostermann_substeps(
      state, dt, tolerance, first,
      [&](const PlaneState& y, PlaneRate& f) {
        f = rate_of(law, y, point);
        return true;
      },
      [&law](const PlaneState& y) { return law.in_domain(y); }, [](double) {});
  EXPECT_TRUE(done.has_value());
  return state;
}

class VhpMaterialTest : public testing::Test {
 protected:
  const model::Law<double> law_{tests::seed_mud()};
  [[nodiscard]] VhpMaterial mud(double tolerance) const {
    return VhpMaterial(law_.parameters(), {tolerance, kLeastPressure, 300e3});
  }
};

TEST_F(VhpMaterialTest, EasyStepIsTheMidpointStepOfTheScalarLaw) {
  constexpr double kStep = 1e-5;  // s
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<Point> points = random_points(0.5, seed);
    MovingPoints particles = particles_of(points);
    const MaterialCount count = update(mud(kSlumpTolerance), particles, kStep);
    EXPECT_EQ(count.substepped, 0);
    EXPECT_EQ(count.floored, 0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const PlaneState expected = midpoint_steps(law_, points[i], kStep, 1);
      EXPECT_GT((expected.stress - points[i].state.stress).norm(), 1e-6 * expected.stress.norm());
      EXPECT_LT((stress_of(particles, i) - expected.stress).norm(), 1e-12 * expected.stress.norm())
          << "seed " << seed << ", point " << i;
      EXPECT_NEAR(particles.void_ratio[i], expected.void_ratio, 1e-14 * expected.void_ratio);
    }
  }
}

// Every point alike, so that the number of substeps of the pack is that of the point: it follows from the
// error of one substep, and every pack is as accurate as the scalar law in as many midpoint steps.
TEST_F(VhpMaterialTest, PackSubstepsAreMidpointStepsOfTheScalarLaw) {
  std::vector<int> seen;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Point point = random_points(1.0, seed).front();
    const double dt = 1e-3 * (1 + seed % 12);
    MovingPoints particles = particles_of(std::vector<Point>(kPoints, point));
    const MaterialCount count = update(mud(kSlumpTolerance), particles, dt);
    if (count.substepped > 0) continue;
    int matches = 0;
    for (int substeps = 1; substeps <= 24; ++substeps) {
      const PlaneState expected = midpoint_steps(law_, point, dt, substeps);
      const double size = expected.stress.norm();
      if (!((stress_of(particles, 0) - expected.stress).norm() < 1e-12 * size)) continue;
      ++matches;
      seen.push_back(substeps);
      for (std::size_t i = 0; i < kPoints; ++i) {
        EXPECT_EQ(stress_of(particles, i), stress_of(particles, 0));
        EXPECT_NEAR(particles.void_ratio[i], expected.void_ratio, 1e-14 * expected.void_ratio);
      }
    }
    EXPECT_EQ(matches, 1) << "seed " << seed;
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_GE(std::unique(seen.begin(), seen.end()) - seen.begin(), 4) << "too few numbers of substeps to tell";
}

TEST_F(VhpMaterialTest, PackSubstepsMeetTheTolerance) {
  constexpr double kStep = 0.01;
  const std::vector<Point> points = random_points(1.0, 2);
  MovingPoints particles = particles_of(points);
  EXPECT_EQ(update(mud(kSlumpTolerance), particles, kStep).floored, 0);
  double worst_of_one = 0.0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const PlaneState expected = converged(law_, points[i], kStep);
    EXPECT_LT((stress_of(particles, i) - expected.stress).norm(), kSlumpTolerance * expected.stress.norm())
        << "point " << i;
    EXPECT_NEAR(particles.void_ratio[i], expected.void_ratio, kSlumpTolerance * expected.void_ratio);
    const PlaneState single = midpoint_steps(law_, points[i], kStep, 1);
    worst_of_one = std::max(worst_of_one, (single.stress - expected.stress).norm() / expected.stress.norm());
  }
  EXPECT_GT(worst_of_one, 2.0 * kSlumpTolerance) << "the step is too easy to test substeps";
}

TEST_F(VhpMaterialTest, TighterToleranceComesCloser) {
  constexpr double kStep = 1e-3;
  const std::vector<Point> points = random_points(1.0, 3);
  std::vector<double> worst;
  for (const double tolerance : {1e-3, 1e-5}) {
    MovingPoints particles = particles_of(points);
    update(mud(tolerance), particles, kStep);
    worst.push_back(0.0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const PlaneState expected = converged(law_, points[i], kStep);
      worst.back() =
          std::max(worst.back(), (stress_of(particles, i) - expected.stress).norm() / expected.stress.norm());
    }
  }
  EXPECT_LT(worst[1], 0.1 * worst[0]);
}

TEST_F(VhpMaterialTest, ViolentPointIsSubsteppedByItselfAndAccurate) {
  constexpr double kStep = 1e-3;
  std::vector<Point> points = random_points(0.01, 4);
  points[5].strain_rate *= 3000.0;
  MovingPoints particles = particles_of(points);
  const MaterialCount count = update(mud(kSlumpTolerance), particles, kStep);
  EXPECT_EQ(count.substepped, 1);
  EXPECT_EQ(count.floored, 0);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const PlaneState expected = converged(law_, points[i], kStep);
    EXPECT_LT((stress_of(particles, i) - expected.stress).norm(), kSlumpTolerance * expected.stress.norm())
        << "point " << i;
  }
}

// Isotropic unloading at 1 /s over 0.1 s divides p' by exp(0.3/0.0129), about 1e10: contact is lost.
TEST_F(VhpMaterialTest, PointThatLosesContactIsSetToTheLeastPressureAndCounted) {
  constexpr double kStep = 0.1;
  std::vector<Point> points = random_points(1e-4, 5);
  points[9].state.stress << -600.0, -600.0, -600.0, 0.0;
  points[9].strain_rate << 1.0, 1.0, 1.0, 0.0;
  MovingPoints particles = particles_of(points);
  const MaterialCount count = update(mud(kSlumpTolerance), particles, kStep);
  EXPECT_EQ(count.substepped, 1);
  EXPECT_EQ(count.floored, 1);
  const Vector4 expected(-kLeastPressure, -kLeastPressure, -kLeastPressure, 0.0);
  EXPECT_EQ(stress_of(particles, 9), expected);
  // d ln(1+e) = tr D dt
  EXPECT_NEAR(particles.void_ratio[9], (1.0 + points[9].state.void_ratio) * std::exp(0.3) - 1.0, 1e-12);
  for (std::size_t i = 0; i < kPoints; ++i) {
    if (i == 9) continue;
    const PlaneState reference = converged(law_, points[i], kStep);
    EXPECT_LT((stress_of(particles, i) - reference.stress).norm(), kSlumpTolerance * reference.stress.norm());
  }
}

// While it is pulled apart further it stays there; compressed again, p' grows by exp(tr D dt/kappa).
TEST_F(VhpMaterialTest, PointAtTheLeastPressureStaysThereUntilItIsCompressed) {
  constexpr double kStep = 1e-4;
  std::vector<Point> points = random_points(1e-4, 5);
  points[9].state.stress << -kLeastPressure, -kLeastPressure, -kLeastPressure, 0.0;
  points[9].strain_rate << 1.0, 1.0, 1.0, 0.0;
  MovingPoints particles = particles_of(points);
  const Vector4 least(-kLeastPressure, -kLeastPressure, -kLeastPressure, 0.0);
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(update(mud(kSlumpTolerance), particles, kStep).floored, 1);
    EXPECT_EQ(stress_of(particles, 9), least);
  }
  EXPECT_NEAR(particles.void_ratio[9], (1.0 + points[9].state.void_ratio) * std::exp(9e-4) - 1.0, 1e-12);
  for (std::size_t k = 0; k < 3; ++k) particles.strain_rate[k][9] = -1.0;
  EXPECT_EQ(update(mud(kSlumpTolerance), particles, kStep).floored, 0);
  const double grown = particles.mean_effective_pressure(9) / kLeastPressure;
  EXPECT_GT(grown, 1.0);
  EXPECT_LT(grown, std::exp(3e-4 / law_.parameters().kappa()));
}

TEST_F(VhpMaterialTest, StressFollowsARigidRotation) {
  // spin W12 = w turns T by the angle -w t about axis 3; stiffness and viscosity aside (D = 0, OCR large)
  constexpr double kSpin = 0.3;
  constexpr double kStep = 0.5;
  constexpr int kSteps = 50;
  Point point{{{-700.0, -500.0, -600.0, 0.0}, 3.0}, Vector4::Zero(), kSpin};
  std::vector<Point> points(kPoints, point);
  MovingPoints particles = particles_of(points);
  const VhpMaterial material = mud(1e-3);
  for (int n = 0; n < kSteps; ++n) update(material, particles, kStep / kSteps);
  const double angle = 2.0 * kSpin * kStep;
  EXPECT_NEAR(particles.stress[0][0], -600.0 - 100.0 * std::cos(angle), 1e-3);
  EXPECT_NEAR(particles.stress[1][0], -600.0 + 100.0 * std::cos(angle), 1e-3);
  EXPECT_NEAR(particles.stress[2][0], -600.0, 1e-3);
  // d T12/dt = w (T22 - T11) > 0
  EXPECT_NEAR(particles.stress[3][0], std::sqrt(2.0) * 100.0 * std::sin(angle), 1e-2);
}

}  // namespace
}  // namespace isotach::mpm
