// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The state the mud starts from: void ratio, pressures, density, weight.
#include <cmath>

#include "model/law.hpp"
#include "mpm/gravity.hpp"
#include "mpm/slump.hpp"

namespace isotach::mpm {

namespace {

/// C_u / p_B at the undrained critical state
double strength_ratio(const model::Law<double>& law, double rate) {
  const auto& parameters = law.parameters();
  return 0.25 * law.critical_ratio() *
         std::pow(rate * (1.0 - parameters.C_1()) / parameters.D_r(), parameters.I_v());
}

}  // namespace

double void_ratio_from_strength(const model::Parameters<double>& parameters, double undrained_strength,
                                double strength_rate) {
  const model::Law<double> law(parameters);
  return law.void_ratio_at(undrained_strength / strength_ratio(law, strength_rate));
}

double critical_state_strength(const model::Parameters<double>& parameters, const InitialState& initial,
                               double rate) {
  return initial.preconsolidation_pressure * strength_ratio(model::Law<double>(parameters), rate);
}

InitialState initial_state(const model::Parameters<double>& parameters, const Mud& mud) {
  const model::Law<double> law(parameters);
  InitialState state;
  state.strength_rate = mud.strength_rate.value_or(parameters.D_r());
  state.void_ratio = mud.void_ratio ? *mud.void_ratio
                                    : void_ratio_from_strength(parameters, mud.undrained_strength.value(),
                                                               state.strength_rate);
  state.preconsolidation_pressure = law.preconsolidation_pressure(state.void_ratio);
  state.mean_effective_pressure = state.preconsolidation_pressure / mud.overconsolidation_ratio;
  state.density = kWaterDensity * (mud.specific_gravity + state.void_ratio) / (1.0 + state.void_ratio);
  state.undrained_strength = critical_state_strength(parameters, state, state.strength_rate);
  return state;
}

double fill_pressure(const model::Parameters<double>& parameters, const SlumpSetup& setup) {
  return initial_state(parameters, setup.mud).density * kGravity * setup.mould.fill_height;
}

}  // namespace isotach::mpm
