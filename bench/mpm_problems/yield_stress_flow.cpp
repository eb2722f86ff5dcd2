// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/yield_stress_flow.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "bench/mpm_problems/regular_points.hpp"
#include "mpm/engine.hpp"
#include "mpm/materials/viscoplastic.hpp"
#include "mpm/outline.hpp"

namespace isotach::bench {

namespace {

using mpm::Engine;
using mpm::Particles;
using mpm::Side;

/// Points that stand as far as they can by themselves: uniaxial stress below the yield stress; below that
/// height the rest is what the mould carried. So what does not flow does not strain either.
Particles standing_points(const Pile& pile) {
  Particles q = regular_points(pile.radius, pile.height, 0.5 * pile.cell_size, mpm::Symmetry::axisymmetric,
                               kPileDensity);
  for (std::size_t i = 0; i < q.count; ++i) {
    const double above = kPileDensity * kPileGravity * (pile.height - q.z[i]);
    const double carried = std::min(above, std::numbers::sqrt3 * pile.yield_stress);
    q.stress[0].push_back(carried / 3.0);
    q.stress[1].push_back(-2.0 * carried / 3.0);
    q.stress[2].push_back(carried / 3.0);
    q.reference_pressure.push_back(above - 2.0 * carried / 3.0);
  }
  return q;
}

Engine engine_of(const Pile& pile) {
  mpm::Grid grid(pile.cell_size, pile.width, pile.height + 2.0 * pile.cell_size,
                 {Side::symmetric, Side::open, Side::fixed, Side::open});
  mpm::EngineSettings settings;
  settings.gravity = kPileGravity;
  Engine engine(std::move(grid), settings);
  mpm::Body body;
  body.particles = standing_points(pile);
  body.material = std::make_unique<mpm::ViscoplasticMaterial>(mpm::ViscoplasticMaterial::Constants{
      pile.bulk_modulus, pile.shear_modulus, pile.yield_stress, pile.consistency, 1.0});
  body.density = kPileDensity;
  body.averaged = pile.averaged;
  engine.add(std::move(body));
  engine.add(std::make_unique<Drag>(pile.drag));
  if (!pile.rough) {
    mpm::BaseFriction smooth;
    smooth.adhesion = 0.0;
    engine.set_base(smooth);
  }
  return engine;
}

double volume_of(const Particles& q) {
  double sum = 0.0;
  for (std::size_t i = 0; i < q.count; ++i) sum += q.volume(i);
  return sum;
}

/// Steps to `time`; false where a point leaves the grid.
bool run_to(Engine& engine, double time, double& fastest) {
  while (engine.time() < time) {
    if (engine.step(time)) return false;
    if (engine.steps() % 16 == 0) fastest = std::max(fastest, engine.energies().kinetic);
  }
  return true;
}

}  // namespace

PileAtRest settle(const Pile& pile) {
  Engine engine = engine_of(pile);
  const Particles& q = engine.bodies().front().particles;
  const double potential = engine.energies().potential;
  const double volume = volume_of(q);
  PileAtRest rest{};
  const double rates_from = 0.9 * pile.duration;
  rest.failed = !run_to(engine, rates_from, rest.fastest_kinetic);
  const mpm::Outline before = trace_outline(q, pile.cell_size, engine.time());
  rest.failed = rest.failed || !run_to(engine, pile.duration, rest.fastest_kinetic);
  const mpm::Outline outline = trace_outline(q, pile.cell_size, engine.time());
  rest.height = outline.height();
  rest.toe = outline.toe();
  rest.reach = *std::max_element(q.r.begin(), q.r.begin() + static_cast<std::ptrdiff_t>(q.count));
  rest.height_rate = (outline.height() - before.height()) / (pile.duration - rates_from);
  rest.toe_rate = (outline.toe() - before.toe()) / (pile.duration - rates_from);
  rest.kinetic_share = engine.energies().kinetic / potential;
  rest.fastest_kinetic /= potential;
  rest.volume_error = volume_of(q) / volume - 1.0;
  for (const mpm::OutlinePoint& point : outline.points) {
    rest.r.push_back(point.r);
    rest.z.push_back(point.z);
  }
  return rest;
}

double slump_law(double dimensionless_yield_stress) {
  const double x = std::numbers::sqrt3 * dimensionless_yield_stress;
  return x >= 1.0 ? 0.0 : 1.0 - x * (1.0 - std::log(x));
}

double spread_law(double density, double volume, double yield_stress) {
  return std::pow(225.0 * density * kPileGravity * volume * volume /
                      (128.0 * std::numbers::pi * std::numbers::pi * yield_stress),
                  0.2);
}

double spread_law_with_front(double density, double volume, double yield_stress, double layer) {
  const double thickness = yield_stress / (density * kPileGravity);
  const double first = spread_law(density, volume, yield_stress);
  const double front =
      0.5 * std::numbers::pi * (std::numbers::pi * thickness + layer) * first * first / volume;
  // x^(5/2) + front x^2 = 1 for the ratio x of the radii; the left side grows with x
  double low = 0.0;
  double high = 1.0;
  for (int n = 0; n < 60; ++n) {
    const double x = 0.5 * (low + high);
    (std::pow(x, 2.5) + front * x * x < 1.0 ? low : high) = x;
  }
  return low * first;
}

}  // namespace isotach::bench
