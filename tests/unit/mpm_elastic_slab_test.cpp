// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The elastic slab and the tie that lets a body rest on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "mpm/engine.hpp"
#include "mpm/materials/viscoplastic.hpp"
#include "mpm/plane_tie.hpp"
#include "mpm/slab_engine.hpp"

namespace isotach::mpm {
namespace {

constexpr double kCell = 0.005;                            // m
constexpr double kRadius = 0.04;                           // m, of the column
constexpr double kHeight = 0.05;                           // m
constexpr double kDensity = 1300.0;                        // kg/m3
constexpr double kGravity = 9.81;                          // m/s2
constexpr double kBulk = 2e5;                              // Pa
constexpr double kWeight = kDensity * kGravity * kHeight;  // Pa on the base

EngineSettings settings() {
  EngineSettings result;
  result.gravity = kGravity;
  return result;
}

/// A column of shear modulus G (Pa), at rest under its own weight where it cannot spread.
Body column(double shear_modulus) {
  Body result;
  Particles& q = result.particles;
  const double step = 0.5 * kCell;
  for (double z = 0.5 * step; z < kHeight; z += step) {
    for (double r = 0.5 * step; r < kRadius; r += step) {
      q.r.push_back(r);
      q.z.push_back(z);
      q.mass.push_back(kDensity * step * step * r);
      q.solid_volume.push_back(step * step * r);
      q.reference_pressure.push_back(kDensity * kGravity * (kHeight - z));
    }
  }
  q.count = q.r.size();
  result.material =
      std::make_unique<ViscoplasticMaterial>(ViscoplasticMaterial::Constants{kBulk, shear_modulus});
  result.density = kDensity;
  return result;
}

/// A drag -rate m v, so that a column comes to rest.
class Drag final : public PointForce {
 public:
  explicit Drag(double rate) : rate_(rate) {}
  void add(const ForceBlock& block) const override {
    for (std::size_t p = 0; p < block.count; ++p) {
      const std::size_t i = block.begin + p;
      block.loads.add(p, 0.0, -rate_ * block.particles.mass[i] * block.particles.velocity_z[i]);
    }
  }

 private:
  double rate_;
};

Engine column_on(Side right, Side bottom, double shear_modulus, double width = kRadius) {
  Engine engine(Grid(kCell, width, kHeight + 4 * kCell, {Side::symmetric, right, bottom, Side::open}),
                settings());
  engine.add(column(shear_modulus));
  return engine;
}

/// The column in a tube, on a slab that reaches 20 mm beyond it.
Engine column_on_slab(ElasticSlab slab, const SlabLoad& load) {
  Engine engine = column_on(Side::symmetric, Side::open, 1e3);
  slab.length = 0.06;
  engine.rest_on(slab_engine(slab, kCell, load, engine.settings()));
  return engine;
}

void run_to(Engine& engine, double end) {
  while (engine.time() < end) ASSERT_FALSE(engine.step(end).has_value());
}

/// How far points of the slab well inside of the loaded circle have gone down, over what a face that is
/// `settlement` lower brings with it at their heights: least and largest.
std::pair<double, double> relative_settlement(const Engine& engine, double settlement) {
  const Particles& q = engine.floor()->bodies().front().particles;
  const double thickness = engine.floor()->grid().height();
  const double step = 0.5 * kCell;
  std::pair result{HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < q.count; ++i) {
    if (q.r[i] > 0.5 * kRadius) continue;
    const double start = (std::floor(q.z[i] / step) + 0.5) * step;
    const double relative = (start - q.z[i]) / (settlement * start / thickness);
    result = {std::min(result.first, relative), std::max(result.second, relative)};
  }
  return result;
}

// One-dimensional elasticity: w = p t (1 + nu)(1 - 2 nu)/((1 - nu) E). Slabs that are no whole number of
// cells thick settle like those that are. The load's edge is four thicknesses away; stress there fades faster
// than by a factor of ten a thickness.
TEST(ElasticSlab, SettlesUnderAColumnByItsConfinedModulus) {
  for (const double thickness : {0.005, 0.007, 0.010}) {
    for (const double nu : {0.0, 0.3}) {
      ElasticSlab slab;
      slab.thickness = thickness;
      slab.youngs_modulus = 2e5;
      slab.poissons_ratio = nu;
      const double expected =
          kWeight * thickness * (1.0 + nu) * (1.0 - 2.0 * nu) / ((1.0 - nu) * slab.youngs_modulus);
      EXPECT_NEAR(slab.settlement(kWeight), expected, 1e-12 * expected);
      Engine engine = column_on_slab(slab, {});
      engine.add(std::make_unique<Drag>(500.0));  // nearly critical for the column's first mode
      run_to(engine, 0.15);
      const auto [least, largest] = relative_settlement(engine, expected);
      EXPECT_NEAR(least, 1.0, 0.02) << thickness << ", " << nu;
      EXPECT_NEAR(largest, 1.0, 0.02) << thickness << ", " << nu;
    }
  }
}

// A slab that starts without the stress below the column swings to twice the settlement. With it, what is
// left comes from the column, whose start is off by a per cent or two at its ends, where sums over points
// stand for integrals: less than a tenth of the settlement, and so a hundredth of the energy in each of the
// two.
TEST(ElasticSlab, BeginsAtRestUnderWhatStandsOnIt) {
  ElasticSlab slab;
  slab.youngs_modulus = 2e5;
  Engine loaded = column_on_slab(slab, {kWeight, kRadius});
  Engine let_go = column_on_slab(slab, {});
  double kinetic = 0.0;
  double kinetic_let_go = 0.0;
  for (double end = 0.0005; end < 0.02; end += 0.0005) {
    run_to(loaded, end);
    run_to(let_go, end);
    kinetic = std::max(kinetic, loaded.energies().kinetic);
    kinetic_let_go = std::max(kinetic_let_go, let_go.energies().kinetic);
    const auto [least, largest] = relative_settlement(loaded, slab.settlement(kWeight));
    EXPECT_GT(least, -0.1);
    EXPECT_LT(largest, 0.1);
  }
  EXPECT_LT(kinetic, 0.02 * kinetic_let_go);
}

// A column that is let go, in the same steps on each base. The difference from the rigid base is the slab's
// compliance: it goes with 1/E, with no part that the size of cells makes.
TEST(ElasticSlab, IsTheRoughBaseInTheLimit) {
  static constexpr double kStep = 4e-5;  // s, less than the stiffest needs
  static constexpr int kSteps = 150;
  const auto run = [](Engine engine) {
    for (int n = 1; n <= kSteps; ++n) EXPECT_FALSE(engine.step(n * kStep).has_value());
    EXPECT_EQ(engine.steps(), kSteps);
    return engine;
  };
  const Engine rough = run(column_on(Side::open, Side::fixed, 5e3, 0.1));
  const auto gap = [&](double youngs_modulus) {
    Engine engine = column_on(Side::open, Side::open, 5e3, 0.1);
    ElasticSlab slab;
    slab.youngs_modulus = youngs_modulus;
    slab.length = 0.06;
    engine.rest_on(slab_engine(slab, kCell, {kWeight, kRadius}, engine.settings()));
    engine = run(std::move(engine));
    const Particles& a = rough.bodies().front().particles;
    const Particles& b = engine.bodies().front().particles;
    double largest = 0.0;
    for (std::size_t i = 0; i < a.count; ++i) {
      largest = std::max({largest, std::abs(a.r[i] - b.r[i]), std::abs(a.z[i] - b.z[i])});
    }
    return largest;
  };
  const double soft = gap(1e5);
  const double stiff = gap(1e6);
  const double stiffer = gap(1e7);
  EXPECT_GT(soft, 1e-5);
  EXPECT_NEAR(soft / stiff, 10.0, 2.0);
  EXPECT_NEAR(stiff / stiffer, 10.0, 2.0);
}

TEST(ElasticSlab, WhatRunsBeyondItEndsTheRunAtItsEdge) {
  Engine engine = column_on(Side::open, Side::open, 1e2, 0.2);
  ElasticSlab slab;
  slab.length = 0.06;
  engine.rest_on(slab_engine(slab, kCell, {kWeight, kRadius}, engine.settings()));
  std::optional<EngineFailure> failure;
  while (!failure && engine.time() < 1.0) failure = engine.step(1.0);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->kind, EngineFailure::Kind::left_floor) << failure->message;
  EXPECT_NEAR(failure->r, slab.length, 2.0 * kCell);
  EXPECT_NE(failure->message.find("runs beyond"), std::string::npos) << failure->message;
}

// The energy that the column loses at its bottom is what the slab gains.
TEST(ElasticSlab, WorkOnItIsWhatTheBodyAboveGives) {
  ElasticSlab slab;
  slab.youngs_modulus = 1e5;
  Engine engine = column_on_slab(slab, {});
  run_to(engine, 0.02);
  const double given = engine.energies().boundary_work;
  const Energies floor = engine.floor()->energies();
  EXPECT_GT(given, 0.0);
  EXPECT_NEAR(-floor.boundary_work, given, 1e-9 * given);
  EXPECT_LT(floor.kinetic + floor.stress_work, given);  // passes between points and nodes may lose energy
  EXPECT_GT(floor.kinetic + floor.stress_work, 0.8 * given);
}

TEST(ElasticSlab, AFloorThatDoesNotFitIsRefused) {
  Engine engine = column_on(Side::symmetric, Side::open, 1e3);
  EXPECT_THROW(engine.rest_on(nullptr), std::invalid_argument);
  EXPECT_THROW(engine.rest_on(slab_engine({}, 0.5 * kCell, {}, settings())), std::invalid_argument);
  Engine fixed = column_on(Side::symmetric, Side::fixed, 1e3);
  EXPECT_THROW(fixed.rest_on(slab_engine({}, kCell, {}, settings())), std::invalid_argument);
}

class PlaneTie : public testing::Test {
 protected:
  PlaneTie() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (NodeSums* sums : {&above_, &below_}) {
      for (std::size_t row = 0; row < kRows; ++row) {
        sums->touch(row, kColumns);
        for (std::size_t i = 0; i < kColumns; ++i) {
          Octet& node = sums->data()[row * kColumns + i];
          for (std::size_t k = 0; k < 8; ++k) node[k] = any(random);
          node[kMass] = 0.01 + node[kMass] * node[kMass];
        }
      }
    }
  }
  [[nodiscard]] std::array<Octet, 4> tied(std::size_t i) const {
    return {above_.data()[i], above_.data()[kColumns + i], below_.data()[(kRows - 2) * kColumns + i],
            below_.data()[(kRows - 1) * kColumns + i]};
  }

  static constexpr std::size_t kRows = 4;
  static constexpr std::size_t kColumns = 5;
  NodeSums above_{kColumns, kRows};
  NodeSums below_{kColumns, kRows};
};

TEST_F(PlaneTie, MeansAreAlikeAndNothingIsTakenAway) {
  std::array<std::array<Octet, 4>, kColumns> before;
  for (std::size_t i = 0; i < kColumns; ++i) before[i] = tied(i);
  ASSERT_FALSE(tie_planes(above_, below_).has_value());
  for (std::size_t i = 0; i < kColumns; ++i) {
    const auto [outer, inner, floor_inner, floor_outer] = tied(i);
    Octet change{};
    for (std::size_t n = 0; n < 4; ++n) change += tied(i)[n] - before[i][n];
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(change[k], 0.0, 1e-14);
    const auto velocity = [](const Octet& n, std::size_t k) { return n[k] / n[kMass]; };
    const auto acceleration = [](const Octet& n, std::size_t internal, std::size_t applied) {
      return (n[internal] + n[applied]) / n[kMass];
    };
    for (const std::size_t k : {kMomentumR, kMomentumZ}) {
      EXPECT_NEAR(velocity(outer, k) + velocity(inner, k),
                  velocity(floor_inner, k) + velocity(floor_outer, k), 1e-11);
    }
    for (const auto& [f, a] : {std::pair(kInternalR, kAppliedR), std::pair(kInternalZ, kAppliedZ)}) {
      EXPECT_NEAR(acceleration(outer, f, a) + acceleration(inner, f, a),
                  acceleration(floor_inner, f, a) + acceleration(floor_outer, f, a), 1e-11);
    }
  }
}

TEST_F(PlaneTie, NamesTheColumnThatHasNothingBelow) {
  below_.data()[(kRows - 1) * kColumns + 3][kMass] = 0.0;
  EXPECT_EQ(tie_planes(above_, below_), 3U);
  above_.data()[3][kMass] = 0.0;  // what does not reach the plane needs nothing below
  EXPECT_FALSE(tie_planes(above_, below_).has_value());
  NodeSums narrow(kColumns, kRows);
  EXPECT_EQ(tie_planes(above_, narrow), 0U);
}

}  // namespace
}  // namespace isotach::mpm
