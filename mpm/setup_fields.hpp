// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// All that decides the outcome of a slump run, field by field and by name: one list for every key made of it.
#pragma once

#include <optional>
#include <type_traits>

#include "mpm/slump_setup.hpp"

namespace isotach::mpm {

/// Calls visit(name, value) for each field of the setup but the number of threads, in an order that stays.
/// Names carry SI units. Values are double, int, bool, std::optional<double>, std::vector<double> and
/// std::vector<RimPlace>; of a setup that is not const they may be set. The bindings name every member, so
/// that a new one does not compile until it is listed here.
template <class Setup, class Visitor>
requires std::is_same_v<std::remove_const_t<Setup>, SlumpSetup>
void visit_fields(Setup& setup, Visitor&& visit) {
  auto& [mould, mud, base, numerics, times, effects, wander] = setup;
  {
    auto& [diameter, fill_height, lift_speed, wall, lift_delay, lift_table] = mould;
    auto& [adhesion, friction] = wall;
    visit("mould_diameter_m", diameter);
    visit("mould_fill_height_m", fill_height);
    visit("mould_lift_speed_m_per_s", lift_speed);
    visit("mould_wall_adhesion_Pa", adhesion);
    visit("mould_wall_friction", friction);
    visit("mould_lift_delay_s", lift_delay);
    visit("mould_lift_table_s_m", lift_table);
  }
  {
    auto& [void_ratio, undrained_strength, strength_rate, specific_gravity, ocr] = mud;
    visit("mud_void_ratio", void_ratio);
    visit("mud_undrained_strength_Pa", undrained_strength);
    visit("mud_strength_rate_per_s", strength_rate);
    visit("mud_specific_gravity", specific_gravity);
    visit("mud_ocr", ocr);
  }
  {
    auto& [yielding, slab] = base;
    auto& [adhesion, friction, slip_length] = yielding;
    visit("base_adhesion_Pa", adhesion);
    visit("base_friction", friction);
    visit("base_slip_length_m", slip_length);
    bool elastic = slab.has_value();
    visit("base_elastic", elastic);
    if constexpr (!std::is_const_v<Setup>) {
      if (elastic != slab.has_value())
        slab = elastic ? std::optional<ElasticSlab>(ElasticSlab{}) : std::nullopt;
    }
    if (elastic) {
      auto& [thickness, length, youngs_modulus, poissons_ratio] = *slab;
      visit("base_thickness_m", thickness);
      visit("base_length_m", length);
      visit("base_youngs_modulus_Pa", youngs_modulus);
      visit("base_poissons_ratio", poissons_ratio);
    }
  }
  {
    auto& [cell_size, points_per_cell, water_bulk_modulus, courant, tolerance, viscosity, threads,
           inertia_scaling, scheme] = numerics;
    static_cast<void>(threads);
    visit("cell_size_m", cell_size);
    visit("points_per_cell", points_per_cell);
    visit("water_bulk_modulus_Pa", water_bulk_modulus);
    visit("courant", courant);
    visit("tolerance", tolerance);
    visit("background_viscosity_Pa_s", viscosity);
    visit("inertia_scaling", inertia_scaling);
    bool plain = scheme == Scheme::plain;
    visit("plain_scheme", plain);
    if constexpr (!std::is_const_v<Setup>) scheme = plain ? Scheme::plain : Scheme::conserving;
  }
  visit("times_s", times);
  {
    auto& [thixotropy, resistance, draining_rate, gradient, surface_tension] = effects;
    auto& [gain, recovery_time, breakdown] = thixotropy;
    auto& [yield_stress, consistency, flow_index] = resistance;
    visit("thixotropy_gain", gain);
    visit("thixotropy_recovery_time_s", recovery_time);
    visit("thixotropy_breakdown", breakdown);
    visit("yield_stress_Pa", yield_stress);
    visit("consistency_Pa_s_n", consistency);
    visit("flow_index", flow_index);
    visit("draining_rate_per_s", draining_rate);
    visit("void_ratio_gradient", gradient);
    visit("surface_tension_N_per_m", surface_tension);
  }
  {
    auto& [slot, at, change] = wander;
    int number = static_cast<int>(slot);
    visit("wander_slot", number);
    if constexpr (!std::is_const_v<Setup>) slot = static_cast<WanderSlot>(number);
    if (slot != WanderSlot::nothing) {
      visit("wander_at", at);
      visit("wander_change", change);
    }
  }
}

}  // namespace isotach::mpm
