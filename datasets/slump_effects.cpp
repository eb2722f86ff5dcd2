// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "datasets/slump_effects.hpp"

#include "effects/basal_slip.hpp"
#include "effects/bleeding.hpp"
#include "effects/high_rate_viscosity.hpp"
#include "effects/lift_delay.hpp"
#include "effects/surface_tension.hpp"
#include "effects/thixotropy.hpp"
#include "effects/wall_adhesion.hpp"
#include "effects/water_layering.hpp"
#include "effects/yield_stress.hpp"

namespace isotach::datasets {

namespace {

void delay_lift(mpm::Mould& mould, double delay) {
  if (mould.lift_table.empty()) {
    mould.lift_delay += delay;
    return;
  }
  for (mpm::RimPlace& place : mould.lift_table) place.time += delay;
}

}  // namespace

mpm::SlumpSetup with_effects(mpm::SlumpSetup setup, const effects::Values<double>& effects) {
  mpm::MudEffects& mud = setup.effects;
  const effects::Values<double> acting = effects.acting_on(effects::TestKind::slump);
  for (const auto& one : acting.chosen()) {
    const auto& si = one.si;
    if (one.effect == &effects::wall_adhesion::kEffect) {
      setup.mould.wall.adhesion += si[effects::wall_adhesion::adhesion];
    } else if (one.effect == &effects::basal_slip::kEffect) {
      setup.base.friction.slip_length += si[effects::basal_slip::slip_length];
    } else if (one.effect == &effects::lift_delay::kEffect) {
      delay_lift(setup.mould, si[effects::lift_delay::delay]);
    } else if (one.effect == &effects::bleeding::kEffect) {
      mud.draining_rate += si[effects::bleeding::rate];
    } else if (one.effect == &effects::thixotropy::kEffect) {
      namespace parameter = effects::thixotropy;
      mud.thixotropy = {si[parameter::s], si[parameter::t_a], si[parameter::beta]};
    } else if (one.effect == &effects::high_rate_viscosity::kEffect) {
      mud.resistance.consistency = si[effects::high_rate_viscosity::K];
      mud.resistance.flow_index = si[effects::high_rate_viscosity::n];
    } else if (one.effect == &effects::water_layering::kEffect) {
      mud.void_ratio_gradient += si[effects::water_layering::g];
    } else if (one.effect == &effects::surface_tension::kEffect) {
      mud.surface_tension += si[effects::surface_tension::tension];
    } else if (one.effect == &effects::yield_stress::kEffect) {
      mud.resistance.yield_stress += si[effects::yield_stress::tau_y];
    }
  }
  return setup;
}

std::optional<std::string> why_not(const mpm::SlumpSetup& setup, const effects::Effect& effect) {
  if (&effect == &effects::wall_adhesion::kEffect && setup.mould.wall.is_rough()) {
    return "its wall is rough, which holds more than any adhesion";
  }
  if (&effect == &effects::basal_slip::kEffect) {
    if (setup.base.slab) return "its base is an elastic slab, which the mud sticks to";
    if (setup.base.friction.limited()) return "its base gives way to shear already";
  }
  return std::nullopt;
}

}  // namespace isotach::datasets
