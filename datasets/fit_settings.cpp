// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [fit], [fit.bounds] and [fit.prior] of a study: implementation.
#include "datasets/fit_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace isotach::datasets {
namespace {

using model::ParameterId;
using model::ParameterInfo;

std::string parameter_names() {
  std::vector<std::string_view> names;
  for (const ParameterInfo& parameter : model::kParameterTable) names.push_back(parameter.name);
  return fmt::format("names among {}", fmt::join(names, ", "));
}

/// What a list of parameters to be fitted holds.
struct Wanted {
  std::vector<ParameterId> material;
  std::vector<FreeEffect> effects;
  std::vector<FreeMud> mud;
};

constexpr std::array<MudQuantity, 2> kMudQuantities{MudQuantity::overconsolidation_ratio,
                                                    MudQuantity::void_ratio};

std::optional<MudQuantity> find_mud_quantity(std::string_view name) {
  for (const MudQuantity quantity : kMudQuantities) {
    if (name_of(quantity) == name) return quantity;
  }
  return std::nullopt;
}

/// Those effects that tests of that kind can have.
effects::Values<double> of_kind(effects::Values<double> effects, effects::TestKind kind) {
  for (const effects::Effect* effect : effects::catalogue()) {
    if (effect->test != kind) effects = effects.without(*effect);
  }
  return effects;
}

/// The parameters of effects that are on and that a fit can move, for messages.
std::string effect_names(const effects::Values<double>& effects) {
  std::string names;
  for (const auto& one : effects.chosen()) {
    for (std::size_t i = 0; i < one.effect->parameters.size(); ++i) {
      const effects::ParameterRef parameter{one.effect, i};
      if (parameter.info().searched()) names += ", " + parameter.name();
    }
  }
  return names;
}

/// A parameter of an effect that is on, by its name.
effects::ParameterRef read_effect_name(const TomlTable& fit, std::string_view key, const std::string& name,
                                       const effects::Values<double>& effects, const std::string& accepted) {
  const auto parameter = effects::find_parameter(name);
  if (!parameter) throw fit.error(key, fmt::format("\"{}\" is not a parameter", name), accepted);
  if (!effects.has(*parameter->effect)) {
    throw fit.error(
        key, fmt::format("\"{}\" is of an effect that [effects] does not have, or not for these tests", name),
        accepted);
  }
  if (!parameter->info().searched()) {
    throw fit.error(key, fmt::format("\"{}\" is a convention, which no fit can move", name), accepted);
  }
  return *parameter;
}

Wanted read_names(TomlTable& fit, std::string_view key, std::vector<ParameterId> defaults,
                  const effects::Values<double>& effects, effects::TestKind kind) {
  const bool slump = kind == effects::TestKind::slump;
  const std::string accepted =
      parameter_names() + (slump ? ", OCR0, e0" : "") + effect_names(effects) + ", each once, at least one";
  const auto names = fit.texts_if(key, accepted);
  if (!names) return {std::move(defaults), {}, {}};
  if (names->empty()) throw fit.error(key, "an empty list", accepted);
  Wanted wanted;
  for (std::size_t i = 0; i < names->size(); ++i) {
    const std::string& name = (*names)[i];
    if (std::find(names->begin(), names->begin() + static_cast<std::ptrdiff_t>(i), name) !=
        names->begin() + static_cast<std::ptrdiff_t>(i)) {
      throw fit.error(key, fmt::format("\"{}\" occurs twice", name), accepted);
    }
    if (const auto parameter = model::find_parameter(name)) {
      wanted.material.push_back(*parameter);
    } else if (const auto mud = slump ? find_mud_quantity(name) : std::nullopt) {
      wanted.mud.push_back({*mud, std::nullopt, std::nullopt});
    } else {
      wanted.effects.push_back({read_effect_name(fit, key, name, effects, accepted), std::nullopt});
    }
  }
  return wanted;
}

std::vector<SlumpRoute> read_routes(TomlTable& fit, std::vector<SlumpRoute> defaults) {
  constexpr std::string_view kKey = "slump_routes";
  constexpr std::array<std::string_view, 3> kNames{"bobyqa", "sbplx", "ceres"};
  constexpr std::array<SlumpRoute, 3> kRoutes{SlumpRoute::bobyqa, SlumpRoute::sbplx, SlumpRoute::ceres};
  const std::string accepted =
      fmt::format("names among {}, each once, at least one", fmt::join(kNames, ", "));
  const auto names = fit.texts_if(kKey, accepted);
  if (!names) return defaults;
  if (names->empty()) throw fit.error(kKey, "an empty list", accepted);
  std::vector<SlumpRoute> routes;
  for (const std::string& name : *names) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) throw fit.error(kKey, fmt::format("\"{}\" is no route", name), accepted);
    const SlumpRoute route = kRoutes[static_cast<std::size_t>(found - kNames.begin())];
    if (std::find(routes.begin(), routes.end(), route) != routes.end()) {
      throw fit.error(kKey, fmt::format("\"{}\" occurs twice", name), accepted);
    }
    routes.push_back(route);
  }
  return routes;
}

bool contains(const std::vector<ParameterId>& parameters, ParameterId id) {
  return std::find(parameters.begin(), parameters.end(), id) != parameters.end();
}

/// [lower, upper] of a parameter, in the unit of its key.
std::optional<Bounds> read_bounds(TomlTable& table, std::string_view name, std::string_view unit,
                                  const Range& admissible, double to_si) {
  const std::string accepted = fmt::format("[lower, upper] with lower < upper, both {}{}", admissible.words(),
                                           unit == "-" ? "" : fmt::format(" {}", unit));
  const auto values = table.numbers_if(name, admissible, accepted);
  if (!values) return std::nullopt;
  if (values->size() != 2) throw table.error(name, fmt::format("a list of {}", values->size()), accepted);
  const auto [lower, upper] = std::pair{(*values)[0], (*values)[1]};
  if (!(lower < upper)) {
    throw table.error(name, fmt::format("[{}, {}] is no interval", lower, upper), accepted);
  }
  return Bounds{to_si * lower, to_si * upper};
}

/// InputError where the bounds of a parameter that is fitted leave out where it starts.
void require_start_inside(const TomlTable& table, std::string_view name, const Bounds& bounds, double start,
                          double to_si, std::string_view where) {
  if (start >= bounds.lower && start <= bounds.upper) return;
  throw table.error(name,
                    fmt::format("[{:.6g}, {:.6g}] leaves out the start value {:.6g}", bounds.lower / to_si,
                                bounds.upper / to_si, start / to_si),
                    fmt::format("an interval around {}", where));
}

void read_effect_bounds(TomlTable& table, const effects::Values<double>& effects, FitSettings& settings) {
  for (const auto& one : effects.chosen()) {
    for (std::size_t i = 0; i < one.effect->parameters.size(); ++i) {
      const effects::ParameterRef parameter{one.effect, i};
      const auto& info = parameter.info();
      if (!info.searched()) continue;
      const std::string name = parameter.name();
      const auto bounds =
          read_bounds(table, name, info.unit, {info.lower, info.upper, info.lower_open, false}, info.to_si);
      for (auto* list : {&settings.oedometer_effects, &settings.slump_effects}) {
        for (FreeEffect& free : *list) {
          if (!bounds || free.parameter != parameter) continue;
          require_start_inside(table, name, *bounds, effects[parameter], info.to_si, name + " of [effects]");
          free.bounds = bounds;
        }
      }
    }
  }
}

void read_mud_bounds(TomlTable& table, FitSettings& settings) {
  for (FreeMud& mud : settings.slump_mud) {
    mud.bounds = read_bounds(table, name_of(mud.quantity), "-", Range::positive(100.0), 1.0);
  }
}

void read_all_bounds(TomlTable& fit, const model::Parameters<double>& material,
                     const effects::Values<double>& effects, FitSettings& settings) {
  auto table = fit.table_if("bounds");
  if (!table) return;
  for (const ParameterInfo& parameter : model::kParameterTable) {
    auto& bounds = settings.bounds[static_cast<std::size_t>(parameter.id)];
    bounds = read_bounds(*table, parameter.name, parameter.unit,
                         {parameter.lower, parameter.upper, parameter.lower_open, true}, parameter.to_si);
    const bool fitted = contains(settings.oedometer, parameter.id) || contains(settings.slump, parameter.id);
    if (!bounds || !fitted) continue;
    require_start_inside(*table, parameter.name, *bounds, material[parameter.id], parameter.to_si,
                         fmt::format("{} of [material]", parameter.key));
  }
  read_effect_bounds(*table, effects, settings);
  read_mud_bounds(*table, settings);
  table->reject_unknown_keys();
}

void read_all_priors(TomlTable& fit, FitSettings& settings) {
  auto table = fit.table_if("prior");
  if (!table) return;
  for (const ParameterInfo& parameter : model::kParameterTable) {
    auto prior = table->table_if(parameter.name);
    if (!prior) continue;
    if (!contains(settings.oedometer, parameter.id)) {
      throw table->error(parameter.name, "a prior on a parameter that the fit does not move",
                         "parameters listed under oedometer in [fit]");
    }
    const Range admissible{parameter.lower, parameter.upper, parameter.lower_open, true};
    const double mean = prior->number("mean", admissible);
    const double std_error = prior->number("std_error", Range::positive());
    prior->reject_unknown_keys();
    settings.priors[static_cast<std::size_t>(parameter.id)] =
        Prior{parameter.to_si * mean, parameter.to_si * std_error};
  }
  for (FreeMud& mud : settings.slump_mud) {
    auto prior = table->table_if(name_of(mud.quantity));
    if (!prior) continue;
    mud.std_error = prior->number("std_error", Range::positive(100.0));
    prior->reject_unknown_keys();
  }
  table->reject_unknown_keys();
}

}  // namespace

std::string_view name_of(MudQuantity quantity) {
  return quantity == MudQuantity::void_ratio ? "e0" : "OCR0";
}

void check_free_mud(const Study& study) {
  for (const FreeMud& mud : study.fit.slump_mud) {
    const std::string_view key = mud.quantity == MudQuantity::void_ratio ? "void_ratio" : "ocr";
    const auto fail = [&](std::string value, std::string accepted) -> void {
      throw InputError(FilePlace{study.file}, fmt::format("[fit] slump, {}", name_of(mud.quantity)),
                       std::move(value), std::move(accepted));
    };
    std::optional<double> first;
    for (const SlumpTest& test : study.slump_tests) {
      const std::optional<double> stated = stated_value(test.setup.mud, mud.quantity);
      if (!stated) {
        fail(fmt::format("{} gives undrained_strength_kPa, from which e0 follows", test.name),
             "slump tests that give void_ratio");
      }
      if (first && *stated != *first) {
        fail(fmt::format("tests start from different values: {:.6g}, and {:.6g} in {}", *first, *stated,
                         test.name),
             fmt::format("the same {} in all slump tests, which then move together", key));
      }
      first = stated;
      if (mud.bounds && !(*stated >= mud.bounds->lower && *stated <= mud.bounds->upper)) {
        fail(fmt::format("[{:.6g}, {:.6g}] of [fit.bounds] leaves out the start value {:.6g}",
                         mud.bounds->lower, mud.bounds->upper, *stated),
             fmt::format("an interval around the tests' {}", key));
      }
    }
  }
}

FitSettings read_fit(TomlTable& root, const model::Parameters<double>& material,
                     const effects::Values<double>& effects) {
  FitSettings settings;
  auto fit = root.table_if("fit");
  if (!fit) return settings;
  Wanted oedometer = read_names(*fit, "oedometer", settings.oedometer,
                                of_kind(effects, effects::TestKind::oedometer), effects::TestKind::oedometer);
  settings.oedometer = std::move(oedometer.material);
  settings.oedometer_effects = std::move(oedometer.effects);
  Wanted slump = read_names(*fit, "slump", settings.slump, of_kind(effects, effects::TestKind::slump),
                            effects::TestKind::slump);
  settings.slump = std::move(slump.material);
  settings.slump_effects = std::move(slump.effects);
  settings.slump_mud = std::move(slump.mud);
  settings.slump_routes = read_routes(*fit, settings.slump_routes);
  constexpr std::array<std::string_view, 3> kGauges{"crs-rate", "fixed", "none"};
  constexpr std::array<Gauge, 3> kGaugeValues{Gauge::crs_rate, Gauge::fixed, Gauge::none};
  settings.gauge = kGaugeValues[fit->choice_if("gauge", kGauges).value_or(0)];
  settings.reference_rate = fit->number_if("reference_rate_per_s", Range::positive(1.0));
  constexpr std::array<std::string_view, 2> kStarts{"data", "material"};
  settings.start = fit->choice_if("start", kStarts).value_or(0) == 0 ? FitStart::data : FitStart::material;
  settings.starts = fit->integer_if("starts", {1.0, 1000.0}).value_or(settings.starts);
  settings.bootstrap = fit->integer_if("bootstrap", {0.0, 100'000.0}).value_or(settings.bootstrap);
  if (const auto seed = fit->integer_if("seed", {0.0, 2'147'483'647.0})) {
    settings.seed = static_cast<unsigned>(*seed);
  }
  read_all_bounds(*fit, material, effects, settings);
  read_all_priors(*fit, settings);
  fit->reject_unknown_keys();
  return settings;
}

}  // namespace isotach::datasets
