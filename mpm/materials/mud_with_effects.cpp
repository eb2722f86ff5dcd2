// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/materials/mud_with_effects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isotach::mpm {

namespace {

/// |D|^2 of the chunk's point p (1/s2).
double squared_rate(const MaterialChunk& chunk, std::size_t p) {
  double squares = 0.0;
  for (const auto& component : chunk.strain_rate) squares += component[p] * component[p];
  return squares;
}

}  // namespace

MudWithEffects::MudWithEffects(const model::Parameters<double>& parameters,
                               const VhpMaterial::Settings& settings, const MudEffects& effects,
                               double void_ratio, const Wander& wander)
    : vhp_(parameters, settings),
      effects_(effects),
      wander_(wander),
      element_{kElasticShare * settings.water_bulk_modulus * (1.0 + void_ratio) / void_ratio,
               effects.resistance.yield_stress, effects.resistance.consistency,
               effects.resistance.flow_index} {}

void MudWithEffects::advance_structure(Particles& q, const MaterialChunk& chunk, double* log_strength) const {
  const Thixotropy& thixotropy = effects_.thixotropy;
  const double recovery = 1.0 / thixotropy.recovery_time;
  for (std::size_t p = 0; p < chunk.count; ++p) {
    const double rate = recovery + thixotropy.breakdown * std::sqrt(2.0 * squared_rate(chunk, p));
    const double steady = recovery / rate;
    double& xi = q.structure[chunk.begin + p];
    const double before = xi;
    xi = steady + (before - steady) * std::exp(-rate * chunk.dt);
    log_strength[p] = std::log1p(thixotropy.gain * 0.5 * (before + xi));
  }
}

void MudWithEffects::add_wander(const Particles& q, const MaterialChunk& chunk, double* log_strength) const {
  if (wander_.slot == WanderSlot::strength_in_rate) {
    for (std::size_t p = 0; p < chunk.count; ++p) {
      log_strength[p] += wander_(0.5 * std::log(squared_rate(chunk, p)));
    }
  } else if (wander_.slot == WanderSlot::strength_in_height) {
    for (std::size_t p = 0; p < chunk.count; ++p) log_strength[p] += q.log_strength[chunk.begin + p];
  } else {
    const double change = wander_.in_time(WanderSlot::strength_in_time, chunk.time);
    for (std::size_t p = 0; p < chunk.count; ++p) log_strength[p] += change;
  }
}

void MudWithEffects::advance_resistance(Particles& q, const MaterialChunk& chunk) const {
  constexpr double root = std::numbers::sqrt2;
  const auto& D = chunk.strain_rate;
  for (std::size_t p = 0; p < chunk.count; ++p) {
    const std::size_t i = chunk.begin + p;
    auto& s = q.resistance;
    const FlowElement::Components t =
        element_.after({s[0][i], s[1][i], s[2][i], s[3][i] / root},
                       {D[0][p], D[1][p], D[2][p], D[3][p] / root}, chunk.spin[p], chunk.dt);
    s[0][i] = t.rr;
    s[1][i] = t.zz;
    s[2][i] = t.tt;
    s[3][i] = root * t.rz;
  }
}

void MudWithEffects::drain(Particles& q, MaterialChunk& chunk) const {
  const double lost = -std::expm1(-effects_.draining_rate * chunk.dt);
  for (std::size_t p = 0; p < chunk.count; ++p) {
    const std::size_t i = chunk.begin + p;
    const double drop = lost * vhp_.pore_pressure(q, i);
    q.reference_pressure[i] -= drop;
    chunk.total_pressure[p] -= drop;
  }
}

void MudWithEffects::update(Particles& q, MaterialChunk& chunk, MaterialCount& count) const {
  alignas(64) std::array<double, kChunk> log_strength;
  if (effects_.thixotropy.acts() || wander_.changes_strength()) {
    std::fill_n(log_strength.data(), Particles::padded(chunk.count, kBlock), 0.0);
    if (effects_.thixotropy.acts()) advance_structure(q, chunk, log_strength.data());
    if (wander_.changes_strength()) add_wander(q, chunk, log_strength.data());
    chunk.log_strength = log_strength.data();
  }
  vhp_.update(q, chunk, count);
  chunk.log_strength = nullptr;
  if (effects_.draining_rate > 0.0) drain(q, chunk);
  if (effects_.resistance.acts()) {
    advance_resistance(q, chunk);
    count.stiffest += 4.0 / 3.0 * element_.shear_modulus;
  }
}

void MudWithEffects::total_pressure(const Particles& q, std::size_t begin, std::size_t count,
                                    double* pressures) const {
  vhp_.total_pressure(q, begin, count, pressures);
}

double MudWithEffects::wave_modulus(const Particles& q, std::size_t i) const {
  const double added = effects_.resistance.acts() ? 4.0 / 3.0 * element_.shear_modulus : 0.0;
  return vhp_.wave_modulus(q, i) + added;
}

}  // namespace isotach::mpm
