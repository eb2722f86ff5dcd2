// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mud that obeys more than its law: thixotropy, a flow resistance, drainage, layers, surface tension.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/layering.hpp"
#include "mpm/materials/mud_with_effects.hpp"
#include "mpm/surface_tension.hpp"
#include "tests/moving_points.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::mpm {
namespace {

using tests::MovingPoints;
using tests::update;

constexpr std::size_t kPoints = 37;  // no multiple of any number of lanes
constexpr double kVoidRatio = 3.891;
constexpr double kPressure = 600.0;  // Pa
const VhpMaterial::Settings kSettings{3e-3, 0.5, 300e3};

/// Points at kPressure that shear at rates of `rate` (1/s) and some more.
MovingPoints shearing(double rate) {
  MovingPoints points(kPoints);
  for (std::size_t i = 0; i < points.spin.size(); ++i) {
    const double here = rate * (1.0 + 0.02 * static_cast<double>(i % kPoints));
    for (std::size_t k = 0; k < 3; ++k) points.stress[k][i] = -kPressure;
    points.void_ratio[i] = kVoidRatio;
    points.structure[i] = 1.0;
    points.strain_rate[0][i] = here;
    points.strain_rate[1][i] = -0.6 * here;
    points.strain_rate[2][i] = -0.4 * here;
    points.strain_rate[3][i] = 0.5 * here;
    points.spin[i] = 0.3 * here;
  }
  return points;
}

double shear_rate(const MovingPoints& points, std::size_t i) {
  double squares = 0.0;
  for (const auto& component : points.strain_rate) squares += component[i] * component[i];
  return std::sqrt(2.0 * squares);
}

// (1+s) p_B(e) is the p_B of mud with 1+e100 larger by (1+s)^lambda: slow points, and those that need
// substeps, in packs and by themselves.
TEST(Thixotropy, ThatNothingBreaksIsALargerE100) {
  constexpr double kGain = 0.8;
  MudEffects effects;
  effects.thixotropy = {kGain, 1e12, 0.0};
  const auto parameters = tests::seed_mud();
  auto values = parameters.values();
  values[model::ParameterId::e100] =
      (1.0 + parameters.e100()) * std::pow(1.0 + kGain, parameters.lambda()) - 1.0;
  const MudWithEffects mud(parameters, kSettings, effects, kVoidRatio);
  const VhpMaterial stronger(*model::Parameters<double>::create(values), kSettings);
  long substepped = 0;
  for (const double rate : {0.1, 10.0, 400.0}) {
    MovingPoints with = shearing(rate);
    MovingPoints without = with;
    for (int step = 0; step < 20; ++step) {
      update(mud, with, 2e-4);
      substepped += update(stronger, without, 2e-4).substepped;
    }
    for (std::size_t i = 0; i < kPoints; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(with.stress[k][i], without.stress[k][i], 1e-7 * kPressure) << rate << ' ' << i;
      }
    }
  }
  EXPECT_GT(substepped, 0) << "no point was done by itself";
}

TEST(Thixotropy, StructureFollowsItsEquation) {
  MudEffects effects;
  effects.thixotropy = {0.5, 20.0, 0.7};
  const MudWithEffects mud(tests::seed_mud(), kSettings, effects, kVoidRatio);
  MovingPoints points = shearing(0.2);
  for (int step = 0; step < 500; ++step) update(mud, points, 2e-3);
  for (const std::size_t i : {std::size_t{0}, kPoints - 1}) {
    const double rate = 1.0 / 20.0 + 0.7 * shear_rate(points, i);
    const double steady = 1.0 / 20.0 / rate;
    EXPECT_NEAR(points.structure[i], steady + (1.0 - steady) * std::exp(-rate * 1.0), 1e-12);
  }
}

TEST(FlowResistance, IsThatOfHerschelAndBulkleyOnceItFlows) {
  MudEffects effects;
  effects.resistance = {20.0, 10.0, 0.5};
  const MudWithEffects mud(tests::seed_mud(), kSettings, effects, kVoidRatio);
  MovingPoints points = shearing(2.0);
  for (auto& spin : points.spin) spin = 0.0;
  for (int step = 0; step < 4000; ++step) update(mud, points, 2e-4);
  for (const std::size_t i : {std::size_t{0}, kPoints - 1}) {
    double squares = 0.0;
    for (const auto& component : points.resistance) squares += component[i] * component[i];
    const double tau = std::sqrt(0.5 * squares);
    EXPECT_NEAR(tau, 20.0 + 10.0 * std::sqrt(shear_rate(points, i)), 1e-6);
    // along the strain rate, which has no volume change here
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(points.resistance[k][i] / tau, 2.0 * points.strain_rate[k][i] / shear_rate(points, i),
                  1e-6);
    }
  }
}

TEST(Bleeding, LetsThePorePressureFadeAtItsRate) {
  MudEffects effects;
  effects.draining_rate = 0.4;
  const MudWithEffects mud(tests::seed_mud(), kSettings, effects, kVoidRatio);
  MovingPoints points = shearing(0.0);
  for (double& reference : points.reference_pressure) {
    reference = mud.vhp().reference_pressure(900.0, kVoidRatio);
  }
  MaterialCount count;
  MaterialChunk chunk{};
  chunk.count = kPoints;
  chunk.dt = 0.01;
  for (int step = 0; step < 100; ++step) mud.update(points, chunk, count);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double left = 900.0 * std::exp(-0.4);
    EXPECT_NEAR(mud.vhp().pore_pressure(points, i), left, 1e-9 * 900.0);
    EXPECT_NEAR(chunk.total_pressure[i] - points.mean_effective_pressure(i), left, 1e-9 * 900.0);
  }
}

TEST(Layering, OverburdenIsTheIntegralOfDensity) {
  for (const double gradient : {-0.8, 1e-7, 0.5, 3.0}) {
    const Layering layering{4.0, gradient, 0.14, 2.65};
    EXPECT_NEAR(layering.void_ratio(0.14) - layering.void_ratio(0.0), gradient, 1e-14);
    for (const double z : {0.0, 0.05, 0.13}) {
      constexpr int kParts = 200;  // Simpson
      const double step = (0.14 - z) / kParts;
      double sum = 0.0;
      for (int k = 0; k <= kParts; ++k) {
        const double weight = k == 0 || k == kParts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
        sum += weight * layering.density(z + k * step);
      }
      EXPECT_NEAR(layering.overburden(z), 9.81 * sum * step / 3.0, 1e-7) << gradient << ' ' << z;
    }
    EXPECT_LT(layering.overburden(0.15), 0.0);
  }
}

/// Volume times capillary stress, added up over the points of a sphere of radius R that touches nothing,
/// 3 x 3 points a cell: rr, zz, hoop.
std::array<double, 3> capillary_virial(double cell_size, double radius, double tension) {
  constexpr double kMiddle = 0.1;
  Grid grid(cell_size, 0.2, 0.2, {Side::symmetric, Side::open, Side::fixed, Side::open});
  const double width = cell_size / 3.0;
  Particles q;
  for (double z = 0.5 * width; z < 0.2; z += width) {
    for (double r = 0.5 * width; r < 0.2; r += width) {
      if (r * r + (z - kMiddle) * (z - kMiddle) > radius * radius) continue;
      q.r.push_back(r);
      q.z.push_back(z);
      q.solid_volume.push_back(0.5 * r * width * width);
      q.void_ratio.push_back(1.0);
    }
  }
  q.count = q.r.size();
  for (auto& component : q.capillary) component.assign(q.count, 0.0);
  SurfaceTension surface(tension, grid);
  surface.prepare(q);
  std::array<double, 3> sums{};
  for (std::size_t p = 0; p < q.count; ++p) {
    for (std::size_t k = 0; k < 3; ++k) sums[k] += q.volume(p) * q.capillary[k][p];
  }
  return sums;
}

// The integral of gamma (I - n n) over a closed surface of area A has the trace 2 gamma A; of a sphere, whose
// area is 2 R^2 per radian, a third of it along each direction.
TEST(SurfaceTension, OfASphereIsTheStressOfItsSurface) {
  constexpr double kTension = 0.07;
  constexpr double kRadius = 0.05;
  const double third = 2.0 / 3.0 * kTension * 2.0 * kRadius * kRadius;
  double before = 1.0;
  for (const double cell_size : {0.01, 0.005, 0.0025}) {
    const auto sums = capillary_virial(cell_size, kRadius, kTension);
    double error = 0.0;
    for (const double sum : {sums[1], 0.5 * (sums[0] + sums[2])}) {
      error = std::max(error, std::abs(sum / third - 1.0));
    }
    EXPECT_LT(error, before) << cell_size;
    before = error;
  }
  EXPECT_LT(before, 0.06);
  const auto once = capillary_virial(0.005, kRadius, kTension);
  const auto twice = capillary_virial(0.005, kRadius, 2.0 * kTension);
  EXPECT_NEAR(twice[1], 2.0 * once[1], 1e-15);
}

}  // namespace
}  // namespace isotach::mpm
