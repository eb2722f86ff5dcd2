// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The time step as a whole: what it must keep, whatever the material.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mpm/engine.hpp"
#include "mpm/materials/viscoplastic.hpp"

namespace isotach::mpm {
namespace {

constexpr double kCell = 0.01;       // m
constexpr double kDensity = 1000.0;  // kg/m3
constexpr double kBulk = 1e5;        // Pa
constexpr double kShear = 4e4;       // Pa

/// Points 2 by 2 a cell where inside(r, z) holds, of volume r dr dz (axisymmetric) or dr dz.
template <class Inside>
Body body(const Grid& grid, Symmetry symmetry, Inside&& inside) {
  Body result;
  Particles& q = result.particles;
  const double step = 0.5 * grid.cell_size();
  for (std::size_t j = 0; j < 2 * grid.rows(); ++j) {
    for (std::size_t i = 0; i < 2 * grid.columns(); ++i) {
      const double r = (static_cast<double>(i) + 0.5) * step;
      const double z = (static_cast<double>(j) + 0.5) * step;
      if (!inside(r, z)) continue;
      const double volume = step * step * (symmetry == Symmetry::axisymmetric ? r : 1.0);
      q.r.push_back(r);
      q.z.push_back(z);
      q.mass.push_back(kDensity * volume);
      q.solid_volume.push_back(volume);
    }
  }
  q.count = q.r.size();
  result.material = std::make_unique<ViscoplasticMaterial>(ViscoplasticMaterial::Constants{kBulk, kShear});
  result.density = kDensity;
  return result;
}

EngineSettings quiet(Symmetry symmetry) {
  EngineSettings settings;
  settings.symmetry = symmetry;
  settings.gravity = 0.0;
  return settings;
}

struct Momenta {
  double mass = 0.0;
  double r = 0.0;
  double z = 0.0;
  double angular = 0.0;  ///< about the origin, that of the affine part included
};

Momenta momenta(const Engine& engine) {
  const Particles& q = engine.bodies().front().particles;
  Momenta sum;
  const double spread = 0.25 * engine.grid().cell_size() * engine.grid().cell_size();
  for (std::size_t i = 0; i < q.count; ++i) {
    sum.mass += q.mass[i];
    sum.r += q.mass[i] * q.velocity_r[i];
    sum.z += q.mass[i] * q.velocity_z[i];
    sum.angular +=
        q.mass[i] * (q.r[i] * q.velocity_z[i] - q.z[i] * q.velocity_r[i] + spread * (q.c_zr[i] - q.c_rz[i]));
  }
  return sum;
}

/// A plate that spins and stretches, free in the middle of an open grid.
Engine free_plate(int threads = 1, double cell = kCell) {
  Grid grid(cell, 30 * kCell, 30 * kCell, {Side::open, Side::open, Side::open, Side::open});
  EngineSettings settings = quiet(Symmetry::plane);
  settings.threads = threads;
  Body plate = body(grid, Symmetry::plane, [](double r, double z) {
    return std::abs(r - 0.15) < 0.05 && std::abs(z - 0.15) < 0.03;
  });
  Particles& q = plate.particles;
  constexpr double kSpin = 4.0;  // rad/s
  for (std::size_t i = 0; i < q.count; ++i) {
    q.velocity_r.push_back(-kSpin * (q.z[i] - 0.15) + 0.1 + 2.0 * (q.r[i] - 0.15));
    q.velocity_z.push_back(kSpin * (q.r[i] - 0.15) - 0.05);
    q.c_rr.push_back(2.0);
    q.c_rz.push_back(-kSpin);
    q.c_zr.push_back(kSpin);
    q.c_zz.push_back(0.0);
  }
  Engine engine(std::move(grid), settings);
  engine.add(std::move(plate));
  return engine;
}

TEST(Engine, AFreeBodyKeepsMassMomentumAndAngularMomentum) {
  Engine engine = free_plate();
  const Momenta before = momenta(engine);
  ASSERT_GT(std::abs(before.angular), 0.01);
  while (engine.time() < 0.3) ASSERT_FALSE(engine.step(0.3).has_value());
  EXPECT_GT(engine.steps(), 400);
  const Momenta after = momenta(engine);
  EXPECT_EQ(after.mass, before.mass);
  EXPECT_NEAR(after.r, before.r, 1e-10 * std::abs(before.r));
  EXPECT_NEAR(after.z, before.z, 1e-10 * std::abs(before.z));
  EXPECT_NEAR(after.angular, before.angular, 1e-10 * std::abs(before.angular));
}

TEST(Engine, EnergyOfAFreeBodyIsThatOfItsMotionAndItsStress) {
  Engine engine = free_plate();
  const Energies start = engine.energies();
  double worst = 0.0;
  while (engine.time() < 0.1) {
    ASSERT_FALSE(engine.step(0.1).has_value());
    const Energies now = engine.energies();
    worst = std::max(worst, std::abs(now.kinetic + now.stress_work - start.kinetic));
  }
  EXPECT_EQ(engine.energies().boundary_work, 0.0);
  EXPECT_LT(worst, 0.02 * start.kinetic);
}

// v_r = -eps r/2, v_z = eps z: every point deforms alike, at constant volume, from the first off the axis on.
TEST(Engine, PatchOfUniformStretchIsExact) {
  constexpr double kRate = 0.5;  // 1/s
  Grid grid(kCell, 12 * kCell, 12 * kCell, {Side::symmetric, Side::open, Side::symmetric, Side::open});
  Body cylinder = body(grid, Symmetry::axisymmetric, [](double r, double z) { return r < 0.08 && z < 0.08; });
  Particles& q = cylinder.particles;
  for (std::size_t i = 0; i < q.count; ++i) {
    q.velocity_r.push_back(-0.5 * kRate * q.r[i]);
    q.velocity_z.push_back(kRate * q.z[i]);
    q.c_rr.push_back(-0.5 * kRate);
    q.c_zz.push_back(kRate);
  }
  Engine engine(std::move(grid), quiet(Symmetry::axisymmetric));
  engine.add(std::move(cylinder));
  constexpr double kStep = 1e-6;
  ASSERT_FALSE(engine.step(kStep).has_value());
  const Particles& after = engine.bodies().front().particles;
  for (std::size_t i = 0; i < after.count; ++i) {
    EXPECT_NEAR(after.l_rr[i], -0.5 * kRate, 1e-11);
    EXPECT_NEAR(after.grid_velocity_r[i] / after.r[i], -0.5 * kRate, 1e-6) << "r = " << after.r[i] / kCell;
    EXPECT_NEAR(after.l_zz[i], kRate, 1e-11);
    EXPECT_NEAR(after.l_rz[i], 0.0, 1e-11);
    EXPECT_NEAR(after.void_ratio[i], 0.0, 1e-16);
    // deviatoric stress of one step, 2 G D dt
    EXPECT_NEAR(after.stress[1][i], 2.0 * kShear * kRate * kStep, 1e-12);
    EXPECT_NEAR(after.stress[0][i], -kShear * kRate * kStep, 1e-12);
    EXPECT_NEAR(after.stress[2][i], -kShear * kRate * kStep, 1e-12);
  }
}

TEST(Engine, PrescribedRigidRotationMakesNoStrain) {
  Grid grid(kCell, 20 * kCell, 20 * kCell, {Side::open, Side::open, Side::open, Side::open});
  Body disc =
      body(grid, Symmetry::plane, [](double r, double z) { return std::hypot(r - 0.1, z - 0.1) < 0.05; });
  Particles& q = disc.particles;
  constexpr double kSpin = 3.0;  // rad/s
  for (std::size_t i = 0; i < q.count; ++i) {
    q.velocity_r.push_back(-kSpin * (q.z[i] - 0.1));
    q.velocity_z.push_back(kSpin * (q.r[i] - 0.1));
    q.c_rz.push_back(-kSpin);
    q.c_zr.push_back(kSpin);
  }
  q.c_rr.assign(q.count, 0.0);
  q.c_zz.assign(q.count, 0.0);
  Engine engine(std::move(grid), quiet(Symmetry::plane));
  engine.add(std::move(disc));
  ASSERT_FALSE(engine.step(1e-5).has_value());
  const Particles& after = engine.bodies().front().particles;
  for (std::size_t i = 0; i < after.count; ++i) {
    EXPECT_NEAR(after.l_rr[i], 0.0, 1e-10);
    EXPECT_NEAR(after.l_zz[i], 0.0, 1e-10);
    EXPECT_NEAR(after.l_rz[i] + after.l_zr[i], 0.0, 1e-10);
    EXPECT_NEAR(after.l_rz[i], -kSpin, 1e-10);
    EXPECT_NEAR(after.stress[0][i], 0.0, 1e-10);
    EXPECT_NEAR(after.stress[3][i], 0.0, 1e-10);
  }
}

/// A block of fluid that slides down over the base with gravity sideways as a friction test: thrown along it.
Engine sliding_block(const BaseFriction& base, double speed) {
  Grid grid(kCell, 60 * kCell, 8 * kCell, {Side::open, Side::open, Side::fixed, Side::open});
  EngineSettings settings = quiet(Symmetry::plane);
  settings.gravity = 9.81;
  Body block = body(grid, Symmetry::plane, [](double r, double z) { return r > 0.1 && r < 0.2 && z < 0.04; });
  Particles& q = block.particles;
  q.velocity_r.assign(q.count, speed);
  q.reference_pressure.resize(q.count);
  for (std::size_t i = 0; i < q.count; ++i) q.reference_pressure[i] = kDensity * 9.81 * (0.04 - q.z[i]);
  Engine engine(std::move(grid), settings);
  engine.add(std::move(block));
  engine.set_base(base);
  return engine;
}

double mean_velocity(const Engine& engine) {
  const Momenta m = momenta(engine);
  return m.r / m.mass;
}

TEST(Engine, BlockOnALimitedBaseIsBrakedByItsLimit) {
  BaseFriction base;
  base.adhesion = 40.0;  // Pa over 0.1 m, of 4 kg: 1 m/s2
  Engine engine = sliding_block(base, 0.5);
  while (engine.time() < 0.2) ASSERT_FALSE(engine.step(0.2).has_value());
  EXPECT_NEAR(mean_velocity(engine), 0.5 - 0.2, 0.02);
}

TEST(Engine, BlockOnARubbingBaseIsBrakedByItsWeight) {
  BaseFriction base;
  base.adhesion = 0.0;
  base.friction = 0.2;  // 1.962 m/s2
  Engine engine = sliding_block(base, 0.5);
  while (engine.time() < 0.2) ASSERT_FALSE(engine.step(0.2).has_value());
  EXPECT_NEAR(mean_velocity(engine), 0.5 - 0.2 * 9.81 * 0.2, 0.02);
}

TEST(Engine, BaseThatYieldsBeyondReachOrSlipsByNothingIsTheRoughBase) {
  const auto run = [](const BaseFriction& base) {
    Engine engine = sliding_block(base, 0.1);
    while (engine.time() < 0.02) EXPECT_FALSE(engine.step(0.02).has_value());
    return engine.bodies().front().particles.r;
  };
  const auto rough = run({});
  BaseFriction strong;
  strong.adhesion = 1e7;
  const auto limited = run(strong);
  BaseFriction near;
  near.slip_length = 1e-9;
  const auto slipping = run(near);
  for (std::size_t i = 0; i < rough.size(); ++i) {
    EXPECT_NEAR(limited[i], rough[i], 1e-12);
    EXPECT_NEAR(slipping[i], rough[i], 1e-8);
  }
}

// The plate turns by 0.08 rad in 40 steps of cells that are small to it: its points change cells and are
// sorted.
TEST(Engine, SameInputAndThreadsGiveTheSameBytesAndOtherThreadsTheSameNumbers) {
  const auto run = [](int threads) {
    Engine engine = free_plate(threads, 0.1 * kCell);
    EXPECT_GE(engine.bodies().front().particles.count, 20000U);
    for (int n = 0; n < 40; ++n) EXPECT_FALSE(engine.step(1.0).has_value());
    return std::pair(engine.bodies().front().particles, momenta(engine));
  };
  const auto [once, momenta_once] = run(1);
  const auto [again, momenta_again] = run(1);
  EXPECT_EQ(once.r, again.r);
  EXPECT_EQ(once.stress[0], again.stress[0]);
  const auto [shared, momenta_shared] = run(2);
  const auto [shared_again, momenta_shared_again] = run(2);
  EXPECT_EQ(shared.r, shared_again.r);
  EXPECT_EQ(shared.stress[0], shared_again.stress[0]);
  EXPECT_NE(shared.stress[0], once.stress[0]) << "two threads had nothing to do";
  double largest = 0.0;
  for (std::size_t i = 0; i < once.count; ++i) {
    largest = std::max(largest, std::abs(once.stress[0][i] - shared.stress[0][i]));
  }
  EXPECT_LT(largest, 1e-6) << "of stresses of some hundred Pa";
  EXPECT_NEAR(momenta_shared.angular, momenta_once.angular, 1e-12);
}

TEST(Engine, StepEndsWhereItIsTold) {
  Engine engine = free_plate();
  ASSERT_FALSE(engine.step(1e-7).has_value());
  EXPECT_EQ(engine.time(), 1e-7);
  ASSERT_FALSE(engine.step(10.0).has_value());
  EXPECT_GT(engine.last_step(), 1e-5);
}

/// Two plates a wide gap apart, so that they share no nodes; the second of the density and moduli given.
Engine two_plates(double density, double bulk) {
  Grid grid(kCell, 30 * kCell, 30 * kCell, {Side::open, Side::open, Side::open, Side::open});
  const auto plate = [&](double middle) {
    return body(grid, Symmetry::plane, [middle](double r, double z) {
      return std::abs(r - 0.15) < 0.05 && std::abs(z - middle) < 0.03;
    });
  };
  Body first = plate(0.08);
  Body second = plate(0.22);
  second.density = density;
  second.material = std::make_unique<ViscoplasticMaterial>(ViscoplasticMaterial::Constants{bulk, kShear});
  Engine engine(std::move(grid), quiet(Symmetry::plane));
  engine.add(std::move(first));
  engine.add(std::move(second));
  return engine;
}

class Push final : public PointForce {
 public:
  void add(const ForceBlock& block) const override {
    for (std::size_t p = 0; p < block.count; ++p) {
      block.loads.add(p, block.particles.mass[block.begin + p], 0.0);
    }
  }
};

TEST(Engine, AForceOnOneBodyLeavesTheOthersAlone) {
  for (const std::size_t pushed : {0U, 1U}) {
    Engine engine = two_plates(kDensity, kBulk);
    engine.add(std::make_unique<Push>(), pushed);
    while (engine.time() < 0.01) ASSERT_FALSE(engine.step(0.01).has_value());
    const Particles& moved = engine.bodies()[pushed].particles;
    const Particles& left = engine.bodies()[1 - pushed].particles;
    for (std::size_t i = 0; i < moved.count; ++i) EXPECT_NEAR(moved.velocity_r[i], 0.01, 1e-12);
    for (std::size_t i = 0; i < left.count; ++i) EXPECT_EQ(left.velocity_r[i], 0.0);
  }
  Engine engine = two_plates(kDensity, kBulk);
  EXPECT_THROW(engine.add(std::make_unique<Push>(), 2), std::out_of_range);
}

// dt = 0.8 h/c of the body whose waves are faster, c = sqrt((K + 4 G/3)/rho): stiff and heavy need not be it.
TEST(Engine, StepIsTheLeastOfWhatTheBodiesAllow) {
  const auto step = [](double density, double bulk) {
    Engine engine = two_plates(density, bulk);
    EXPECT_FALSE(engine.step(1.0).has_value());
    return engine.last_step();
  };
  const auto allowed = [](double density, double bulk) {
    return 0.8 * kCell / std::sqrt((bulk + 4.0 / 3.0 * kShear) / density);
  };
  EXPECT_DOUBLE_EQ(step(kDensity, 25.0 * kBulk), allowed(kDensity, 25.0 * kBulk));
  EXPECT_DOUBLE_EQ(step(kDensity, 0.01 * kBulk), allowed(kDensity, kBulk));
  EXPECT_DOUBLE_EQ(step(100.0 * kDensity, 25.0 * kBulk), allowed(kDensity, kBulk));
}

TEST(Engine, APointThatLeavesTheGridEndsTheRunWithItsPlace) {
  Engine engine = free_plate();
  Particles& q = engine.particles(0);
  for (std::size_t i = 0; i < q.count; ++i) q.velocity_r[i] = 5.0;
  std::optional<EngineFailure> failure;
  while (!failure && engine.time() < 1.0) failure = engine.step(1.0);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->kind, EngineFailure::Kind::left_grid);
  EXPECT_GT(failure->r, 29 * kCell);
  EXPECT_NEAR(failure->time, 0.1 / 5.0, 0.01);
  EXPECT_NE(failure->message.find("leaves the grid"), std::string::npos);
}

}  // namespace
}  // namespace isotach::mpm
