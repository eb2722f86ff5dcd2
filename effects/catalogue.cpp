// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "effects/catalogue.hpp"

#include <array>

#include "effects/anisotropy.hpp"
#include "effects/apparatus_compliance.hpp"
#include "effects/basal_slip.hpp"
#include "effects/bleeding.hpp"
#include "effects/delayed_creep.hpp"
#include "effects/gas.hpp"
#include "effects/high_rate_viscosity.hpp"
#include "effects/lift_delay.hpp"
#include "effects/pore_pressure.hpp"
#include "effects/rate_dependent_viscosity.hpp"
#include "effects/ring_friction.hpp"
#include "effects/seating.hpp"
#include "effects/sensor_drift.hpp"
#include "effects/small_strain_stiffness.hpp"
#include "effects/structure.hpp"
#include "effects/surface_tension.hpp"
#include "effects/temperature.hpp"
#include "effects/thixotropy.hpp"
#include "effects/wall_adhesion.hpp"
#include "effects/water_layering.hpp"
#include "effects/yield_stress.hpp"

namespace isotach::effects {

namespace {

constexpr std::array kCatalogue{
    // of oedometer tests
    &ring_friction::kEffect,
    &apparatus_compliance::kEffect,
    &seating::kEffect,
    &gas::kEffect,
    &structure::kEffect,
    &pore_pressure::kEffect,
    &temperature::kEffect,
    &anisotropy::kEffect,
    &rate_dependent_viscosity::kEffect,
    &small_strain_stiffness::kEffect,
    &delayed_creep::kEffect,
    &sensor_drift::kEffect,
    // of slump tests
    &wall_adhesion::kEffect,
    &basal_slip::kEffect,
    &lift_delay::kEffect,
    &bleeding::kEffect,
    &thixotropy::kEffect,
    &high_rate_viscosity::kEffect,
    &water_layering::kEffect,
    &surface_tension::kEffect,
    &yield_stress::kEffect,
};

static_assert([] {
  for (const Effect* effect : kCatalogue) {
    if (effect->parameters.empty() || effect->parameters.size() > kMostParameters) return false;
  }
  return true;
}());

}  // namespace

std::span<const Effect* const> catalogue() {
  return kCatalogue;
}

const Effect* find_effect(std::string_view name) {
  for (const Effect* effect : kCatalogue) {
    if (effect->name == name) return effect;
  }
  return nullptr;
}

std::string ParameterRef::name() const {
  return std::string(effect->name) + "." + std::string(info().name);
}

std::optional<ParameterRef> find_parameter(std::string_view name) {
  for (const Effect* effect : kCatalogue) {
    for (std::size_t i = 0; i < effect->parameters.size(); ++i) {
      const ParameterRef parameter{effect, i};
      if (parameter.name() == name) return parameter;
    }
  }
  return std::nullopt;
}

std::string searched_names(TestKind test) {
  std::string names;
  for (const Effect* effect : kCatalogue) {
    if (effect->test != test) continue;
    for (std::size_t i = 0; i < effect->parameters.size(); ++i) {
      const ParameterRef parameter{effect, i};
      if (!parameter.info().searched()) continue;
      names += (names.empty() ? "" : ", ") + parameter.name();
    }
  }
  return names;
}

std::string_view name_of(Seam seam) {
  switch (seam) {
    case Seam::law:
      return "law";
    case Seam::boundary:
      return "boundary";
    case Seam::initial_state:
      return "initial state";
    case Seam::instrument:
      return "instrument";
  }
  return "";
}

std::string_view name_of(TestKind test) {
  return test == TestKind::oedometer ? "oedometer" : "slump";
}

}  // namespace isotach::effects
