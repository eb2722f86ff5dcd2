// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Packs of points of a material whose ellipse rotates, against the scalar law.
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
using PlaneState = model::State<double, kPlane>;
using PlaneRate = model::StateRate<double, kPlane>;
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

model::Law<double> rotating_law(double C_2 = 200.0) {
  auto values = tests::seed_mud_values();
  values[model::ParameterId::C_2] = C_2;
  values[model::ParameterId::C_3] = 0.5;
  return model::Law<double>(model::Parameters<double>::create(values).value());
}

VhpMaterial mud(const model::Law<double>& law, double tolerance) {
  return VhpMaterial(law.parameters(), {tolerance, kLeastPressure, 300e3});
}

/// Shears as in a slump: p' 0.3 to 0.9 kPa at e 3.891, |Omega| up to a third of M_c, D up to `rate` (1/s).
std::vector<Point> random_points(double critical_ratio, double rate, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Point> points(kPoints);
  for (Point& point : points) {
    const double p = 600.0 + 300.0 * unit(random);
    for (int k = 0; k < kPlane; ++k) {
      point.state.stress[k] = (k < 3 ? -p : 0.0) + 0.1 * p * unit(random);
      point.state.omega[k] = 0.15 * critical_ratio * unit(random);
      point.strain_rate[k] = rate * unit(random);
    }
    point.state.omega = model::deviator<double, kPlane>(point.state.omega);
    point.strain_rate = model::deviator<double, kPlane>(point.strain_rate);  // undrained
    point.state.void_ratio = 3.891 + 0.02 * unit(random);
    point.spin = rate * unit(random);
  }
  return points;
}

MovingPoints particles_of(const std::vector<Point>& points) {
  MovingPoints particles(points.size(), true);
  for (std::size_t i = 0; i < particles.spin.size(); ++i) {
    const Point& point = points[std::min(i, points.size() - 1)];
    for (std::size_t k = 0; k < kPlane; ++k) {
      const int component = static_cast<int>(k);
      particles.stress[k][i] = point.state.stress[component];
      particles.omega[k][i] = point.state.omega[component];
      particles.strain_rate[k][i] = point.strain_rate[component];
    }
    particles.void_ratio[i] = point.state.void_ratio;
    particles.spin[i] = point.spin;
  }
  return particles;
}

PlaneRate rate_of(const model::Law<double>& law, const PlaneState& y, const Point& point) {
  PlaneRate rate = law.rate(y, point.strain_rate);
  model::add_corotation(rate, y, Eigen::Vector3d(point.spin, 0.0, 0.0));
  return rate;
}

PlaneState midpoint_step(const model::Law<double>& law, const Point& point, double dt) {
  const PlaneState half = advanced(point.state, rate_of(law, point.state, point), 0.5 * dt);
  return advanced(point.state, rate_of(law, half, point), dt);
}

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

TEST(RotatingVhpMaterial, EasyStepIsTheMidpointStepOfTheScalarLaw) {
  constexpr double kStep = 1e-5;  // s
  const model::Law<double> law = rotating_law();
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<Point> points = random_points(law.critical_ratio(), 0.5, seed);
    MovingPoints particles = particles_of(points);
    EXPECT_EQ(update(mud(law, kSlumpTolerance), particles, kStep).substepped, 0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const PlaneState expected = midpoint_step(law, points[i], kStep);
      const PlaneState got = particles.state(i);
      EXPECT_LT((got.stress - expected.stress).norm(), 1e-12 * expected.stress.norm())
          << seed << ", point " << i;
      EXPECT_LT((got.omega - expected.omega).norm(), 1e-12 * expected.omega.norm())
          << seed << ", point " << i;
      EXPECT_GT((got.omega - points[i].state.omega).norm(), 0.0);
      EXPECT_NEAR(got.void_ratio, expected.void_ratio, 1e-14 * expected.void_ratio);
    }
  }
}

TEST(RotatingVhpMaterial, TighterToleranceComesCloserInStressAndOmega) {
  constexpr double kStep = 5e-3;
  const model::Law<double> law = rotating_law(1e4);
  const std::vector<Point> points = random_points(law.critical_ratio(), 1.0, 2);
  std::vector<PlaneState> expected;
  double largest_turn = 0.0;
  for (const Point& point : points) {
    expected.push_back(converged(law, point, kStep));
    largest_turn = std::max(largest_turn, (expected.back().omega - point.state.omega).norm());
  }
  EXPECT_GT(largest_turn, 10.0 * kSlumpTolerance) << "Omega moves too little to tell";
  std::vector<double> stress_error;
  std::vector<double> omega_error;
  for (const double tolerance : {3e-3, 3e-5}) {
    MovingPoints particles = particles_of(points);
    EXPECT_EQ(update(mud(law, tolerance), particles, kStep).floored, 0);
    stress_error.push_back(0.0);
    omega_error.push_back(0.0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const PlaneState got = particles.state(i);
      const double stress = (got.stress - expected[i].stress).norm() / expected[i].stress.norm();
      stress_error.back() = std::max(stress_error.back(), stress);
      omega_error.back() = std::max(omega_error.back(), (got.omega - expected[i].omega).norm());
    }
  }
  EXPECT_LT(stress_error[1], 0.1 * stress_error[0]);
  EXPECT_LT(omega_error[1], 0.1 * omega_error[0]);
  // tolerances are of a substep, of which there are several
  EXPECT_LT(stress_error[0], 10.0 * 3e-3);
  EXPECT_LT(omega_error[0], 10.0 * 3e-3);
}

TEST(RotatingVhpMaterial, LargeStepOfOnePointIsSubsteppedByItselfAndAccurate) {
  constexpr double kStep = 1e-3;
  const model::Law<double> law = rotating_law();
  std::vector<Point> points = random_points(law.critical_ratio(), 0.01, 4);
  points[5].strain_rate *= 3000.0;
  MovingPoints particles = particles_of(points);
  const MaterialCount count = update(mud(law, kSlumpTolerance), particles, kStep);
  EXPECT_EQ(count.substepped, 1);
  EXPECT_EQ(count.floored, 0);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const PlaneState expected = converged(law, points[i], kStep);
    const PlaneState got = particles.state(i);
    EXPECT_LT((got.stress - expected.stress).norm(), kSlumpTolerance * expected.stress.norm())
        << "point " << i;
    EXPECT_LT((got.omega - expected.omega).norm(), kSlumpTolerance * (1.0 + expected.omega.norm()))
        << "point " << i;
  }
}

// The two forms are chosen by C_2: with a C_2 of next to nothing, the form with Omega runs and Omega stays at
// zero.
TEST(RotatingVhpMaterial, FormWithOmegaGivesTheStressesOfTheFormWithout) {
  constexpr double kStep = 1e-4;
  auto values = tests::seed_mud_values();
  values[model::ParameterId::C_2] = 1e-300;
  const VhpMaterial with(model::Parameters<double>::create(values).value(),
                         {kSlumpTolerance, kLeastPressure, 300e3});
  const VhpMaterial without(tests::seed_mud(), {kSlumpTolerance, kLeastPressure, 300e3});
  std::vector<Point> points = random_points(1.0, 0.3, 6);
  for (Point& point : points) point.state.omega.setZero();
  MovingPoints inclined = particles_of(points);
  MovingPoints upright = particles_of(points);
  for (int step = 0; step < 20; ++step) {
    update(with, inclined, kStep);
    update(without, upright, kStep);
  }
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (std::size_t k = 0; k < kPlane; ++k) EXPECT_EQ(inclined.stress[k][i], upright.stress[k][i]);
    EXPECT_EQ(inclined.void_ratio[i], upright.void_ratio[i]);
    EXPECT_LT(inclined.state(i).omega.norm(), 1e-290);
  }
}

TEST(RotatingVhpMaterial, OmegaOfAPointThatLosesContactIsZero) {
  const model::Law<double> law = rotating_law();
  std::vector<Point> points = random_points(law.critical_ratio(), 1e-4, 5);
  points[9].strain_rate << 1.0, 1.0, 1.0, 0.0;
  MovingPoints particles = particles_of(points);
  const MaterialCount count = update(mud(law, kSlumpTolerance), particles, 0.1);
  EXPECT_EQ(count.floored, 1);
  EXPECT_EQ(particles.state(9).omega, Vector4::Zero());
}

}  // namespace
}  // namespace isotach::mpm
