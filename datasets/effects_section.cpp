// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "datasets/effects_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "datasets/slump_effects.hpp"
#include "effects/anisotropy.hpp"

namespace isotach::datasets {
namespace {

using effects::Default;
using effects::EffectParameter;

double default_of(const EffectParameter& parameter, const model::Parameters<double>& material) {
  return parameter.otherwise == Default::material_D_r ? material.D_r() : parameter.typical_si();
}

effects::Chosen<double> read_effect(TomlTable table, const effects::Effect& effect,
                                    const model::Parameters<double>& material) {
  effects::Chosen<double> chosen{&effect, {}};
  for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
    const EffectParameter& parameter = effect.parameters[i];
    const Range accepted{parameter.lower, parameter.upper, parameter.lower_open, false};
    if (parameter.searched()) {
      chosen.si[i] = parameter.to_si * table.number(parameter.name, accepted);
    } else {
      const auto value = table.number_if(parameter.name, accepted);
      chosen.si[i] = value ? parameter.to_si * *value : default_of(parameter, material);
    }
  }
  table.reject_unknown_keys();
  namespace leaning = effects::anisotropy;
  if (&effect == &leaning::kEffect) {
    if (material.rotates()) {
      throw table.error("Omega_0", "given beside C_2 of [material]",
                        "either the effect anisotropy, or C_2 and C_3 of the material");
    }
    if (!(chosen.si[leaning::Omega_0] * chosen.si[leaning::C_3] < 1.0)) {
      throw table.error("C_3", fmt::format("{} is out of range", chosen.si[leaning::C_3]),
                        "below 1/Omega_0, so that an ellipse passes through the critical state");
    }
  }
  return chosen;
}

}  // namespace

effects::Values<double> read_effects(TomlTable& root, const model::Parameters<double>& material) {
  auto table = root.table_if("effects");
  if (!table) return {};
  std::vector<effects::Chosen<double>> chosen;
  for (const effects::Effect* effect : effects::catalogue()) {
    if (auto one = table->table_if(effect->name)) {
      chosen.push_back(read_effect(std::move(*one), *effect, material));
    }
  }
  table->reject_unknown_keys();
  auto values = effects::Values<double>::create(std::move(chosen));
  // an end of a range in a file's unit may round to beyond it in SI
  if (!values) throw InputError(table->place(), "table [effects]: " + values.error().message());
  return *std::move(values);
}

void check_effects(const effects::Values<double>& effects, const OedometerTest& test,
                   const FilePlace& place) {
  const auto fail = [&](const effects::Effect& effect, std::string_view subject, std::string_view accepted) {
    throw InputError(place, fmt::format("oedometer test {}: {}", test.name, subject),
                     fmt::format("it is missing, and the effect {} needs it", effect.name), accepted);
  };
  for (const auto& one : effects.chosen()) {
    const effects::Effect& effect = *one.effect;
    if (effect.need == effects::Need::diameter && !test.diameter) fail(effect, "diameter_mm", "> 0");
    const auto read = [](const OedometerRow& row) { return row.temperature.has_value(); };
    if (effect.need == effects::Need::temperature &&
        std::none_of(test.record.rows.begin(), test.record.rows.end(), read)) {
      fail(effect, "column temperature_C of its data", "a temperature in at least one row");
    }
  }
}

void check_effects(const effects::Values<double>& effects, const std::string& name,
                   const mpm::SlumpSetup& setup, const FilePlace& place) {
  for (const auto& one : effects.chosen()) {
    if (one.effect->test != effects::TestKind::slump) continue;
    if (const auto reason = why_not(setup, *one.effect)) {
      throw InputError(place, fmt::format("slump test {}: effect {}", name, one.effect->name),
                       "the test cannot have it: " + *reason, "an [effects] table without it");
    }
  }
  const double gradient = with_effects(setup, effects).effects.void_ratio_gradient;
  if (setup.mud.void_ratio && !(*setup.mud.void_ratio > 0.5 * std::abs(gradient))) {
    throw InputError(place, fmt::format("slump test {}: effect water_layering", name),
                     fmt::format("g = {} leaves no voids somewhere at a mean void ratio of {}", gradient,
                                 *setup.mud.void_ratio),
                     "below twice the void ratio");
  }
}

void refuse_effects(TomlTable& root) {
  const auto effects = root.table_if("effects");
  if (!effects || effects->empty()) return;
  throw InputError(effects->place(), "table [effects]",
                   "it names effects, which this version cannot simulate in such a test",
                   "no [effects], or an empty one");
}

}  // namespace isotach::datasets
