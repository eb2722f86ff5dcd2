// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fluids and undrained soil on the MPM engine against closed forms, at the least resolution that tells.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/mpm_problems/closed_box.hpp"
#include "bench/mpm_problems/undrained_column.hpp"
#include "bench/mpm_problems/yield_stress_flow.hpp"

namespace isotach::bench {
namespace {

constexpr double kSlumpYield = 0.2;  // tau_y/(rho g H)

Pile column(double slenderness, bool rough) {
  Pile pile;
  pile.radius = 0.5 * pile.height / slenderness;
  pile.yield_stress = kSlumpYield * kPileDensity * kPileGravity * pile.height;
  pile.rough = rough;
  pile.cell_size = pile.radius / 4.0;
  pile.width = 3.6 * pile.radius;
  pile.duration = 2.5;
  return pile;
}

double slump(const Pile& pile) {
  const PileAtRest rest = settle(pile);
  EXPECT_FALSE(rest.failed);
  EXPECT_LT(rest.kinetic_share, 1e-6);
  EXPECT_LT(std::abs(rest.volume_error), 0.005);
  return 1.0 - rest.height / pile.height;
}

// From notes on Pashias et al. (1996), computed by hand.
TEST(SlumpLaw, HasTheKnownValues) {
  EXPECT_NEAR(slump_law(0.05), 0.702, 6e-4);
  EXPECT_NEAR(slump_law(0.1), 0.523, 6e-4);
  EXPECT_NEAR(slump_law(0.2), 0.286, 6e-4);
  EXPECT_NEAR(slump_law(0.4), 0.053, 6e-4);
  EXPECT_EQ(slump_law(0.58), 0.0);
}

// The law's slices feel neither each other nor the base: the limit of slender columns, between a base that
// holds them and one that lets them go.
TEST(Slump, OfSmoothAndRoughBaseCloseInOnTheLaw) {
  const double law = slump_law(kSlumpYield);
  const double smooth_squat = slump(column(1.0, false));
  const double rough_squat = slump(column(1.0, true));
  const double smooth_tall = slump(column(4.0, false));
  const double rough_tall = slump(column(4.0, true));
  EXPECT_GT(smooth_squat, law + 0.05);
  EXPECT_LT(rough_squat, law - 0.03);
  EXPECT_NEAR(smooth_tall, law, 0.035);
  EXPECT_NEAR(rough_tall, law, 0.012);
}

// A column whose foot stays below the yield stress in uniaxial compression, sqrt3 tau_y, stands; one beyond
// it does not.
TEST(Slump, StandsBelowTheYieldStressOnASmoothBase) {
  Pile pile = column(2.0, false);
  pile.duration = 1.0;
  pile.yield_stress = 0.60 * kPileDensity * kPileGravity * pile.height;  // law: 0.577
  EXPECT_LT(std::abs(slump(pile)), 2e-3);
  pile.yield_stress = 0.45 * kPileDensity * kPileGravity * pile.height;
  EXPECT_GT(slump(pile), 0.01);
}

// The deposit's shear takes the height of a cell on the base, so the law is that of a layer of none to one.
TEST(Spread, OfAThinDepositFollowsTheLawWithItsFront) {
  Pile pile;
  pile.height = 0.05;
  pile.radius = 0.1;
  pile.yield_stress = 13.47;
  pile.cell_size = 0.005;
  pile.width = 0.26;
  pile.drag = 80.0;
  pile.duration = 10.0;
  pile.consistency = 0.05;
  pile.bulk_modulus = 2e4;
  pile.shear_modulus = 1e4;
  const double volume = std::numbers::pi * pile.radius * pile.radius * pile.height;
  const double law = spread_law(kPileDensity, volume, pile.yield_stress);
  EXPECT_NEAR(law, 0.2000, 1e-4);  // V = 1.5708e-3 m3
  const PileAtRest rest = settle(pile);
  EXPECT_LT(rest.kinetic_share, 1e-6);
  const double with_front = spread_law_with_front(kPileDensity, volume, pile.yield_stress, 0.0);
  EXPECT_LT(with_front, 0.95 * law);
  EXPECT_LT(rest.toe, with_front);
  EXPECT_GT(rest.toe, spread_law_with_front(kPileDensity, volume, pile.yield_stress, pile.cell_size));
}

// Against one element of the law under the same total stress, integrated apart from the engine.
TEST(UndrainedColumn, WaterAndSkeletonShareALoadAsTheirStiffnessesDo) {
  for (const double bulk : {300e3, 3e6}) {
    MudColumn column;
    column.water_bulk_modulus = bulk;
    const ColumnResult result = load_column(column);
    const ColumnAnswer element = load_element(column);
    EXPECT_NEAR(result.answer.pore_pressure_share, element.pore_pressure_share, 1e-3);
    EXPECT_NEAR(result.answer.skeleton_share, element.skeleton_share, 1e-3);
    EXPECT_NEAR(result.answer.settlement, element.settlement, 2e-3 * element.settlement);
    // K_w (1+e)/e with a little help of the skeleton
    EXPECT_LT(result.answer.settlement, load_springs(column, 0.0).settlement);
    EXPECT_NEAR(result.surface_settlement, element.settlement, 2e-3 * element.settlement);
    EXPECT_LT(result.acting_scatter, 0.005);
    EXPECT_LT(result.own_scatter, 0.005);
    EXPECT_NEAR(result.gradient, 1.0, 0.005);
    EXPECT_LT(result.kinetic, 1e-6);
  }
}

// The exact answer is the same for all K: a body force that bends into a curl.
TEST(Locking, NearlyIncompressibleAnswersConvergeAtSecondOrderWhateverK) {
  for (const auto symmetry : {mpm::Symmetry::plane, mpm::Symmetry::axisymmetric}) {
    const double soft = bend({symmetry, 8, 1e1, true}).amplitude;
    const BoxDeflection coarse = bend({symmetry, 8, 1e4, true});
    const BoxDeflection fine = bend({symmetry, 16, 1e4, true});
    EXPECT_LT(coarse.kinetic, 1e-5);
    EXPECT_NEAR(coarse.amplitude, soft, 1e-3);
    EXPECT_LT(coarse.error, 0.022);
    const double order = std::log2(coarse.error / fine.error);
    EXPECT_GT(order, 1.8);
    EXPECT_LT(order, 2.2);
  }
}

TEST(Locking, WithoutAveragesTheBodyStiffensWithK) {
  for (const auto symmetry : {mpm::Symmetry::plane, mpm::Symmetry::axisymmetric}) {
    EXPECT_LT(bend({symmetry, 8, 1e3, false}).amplitude, 0.7);
    EXPECT_LT(bend({symmetry, 8, 1e4, false}).amplitude, 0.25);
  }
}

}  // namespace
}  // namespace isotach::bench
