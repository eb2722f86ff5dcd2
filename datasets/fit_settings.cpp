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

std::vector<ParameterId> read_names(TomlTable& fit, std::string_view key, std::vector<ParameterId> defaults) {
  const std::string accepted = parameter_names() + ", each once, at least one";
  const auto names = fit.texts_if(key, accepted);
  if (!names) return defaults;
  if (names->empty()) throw fit.error(key, "an empty list", accepted);
  std::vector<ParameterId> parameters;
  for (const std::string& name : *names) {
    const auto parameter = model::find_parameter(name);
    if (!parameter) throw fit.error(key, fmt::format("\"{}\" is not a parameter", name), accepted);
    if (std::find(parameters.begin(), parameters.end(), *parameter) != parameters.end()) {
      throw fit.error(key, fmt::format("\"{}\" occurs twice", name), accepted);
    }
    parameters.push_back(*parameter);
  }
  return parameters;
}

bool contains(const std::vector<ParameterId>& parameters, ParameterId id) {
  return std::find(parameters.begin(), parameters.end(), id) != parameters.end();
}

std::optional<Bounds> read_bounds(TomlTable& table, const ParameterInfo& parameter) {
  const Range admissible{parameter.lower, parameter.upper, parameter.lower_open, true};
  const std::string accepted = fmt::format("[lower, upper] with lower < upper, both {}{}", admissible.words(),
                                           parameter.unit == "-" ? "" : fmt::format(" {}", parameter.unit));
  const auto values = table.numbers_if(parameter.name, admissible, accepted);
  if (!values) return std::nullopt;
  if (values->size() != 2) {
    throw table.error(parameter.name, fmt::format("a list of {}", values->size()), accepted);
  }
  const auto [lower, upper] = std::pair{(*values)[0], (*values)[1]};
  if (!(lower < upper)) {
    throw table.error(parameter.name, fmt::format("[{}, {}] is no interval", lower, upper), accepted);
  }
  return Bounds{parameter.to_si * lower, parameter.to_si * upper};
}

void read_all_bounds(TomlTable& fit, const model::Parameters<double>& material, FitSettings& settings) {
  auto table = fit.table_if("bounds");
  if (!table) return;
  for (const ParameterInfo& parameter : model::kParameterTable) {
    auto& bounds = settings.bounds[static_cast<std::size_t>(parameter.id)];
    bounds = read_bounds(*table, parameter);
    const bool fitted = contains(settings.oedometer, parameter.id) || contains(settings.slump, parameter.id);
    const double start = material[parameter.id];
    if (!bounds || !fitted || (start >= bounds->lower && start <= bounds->upper)) continue;
    throw table->error(
        parameter.name,
        fmt::format("[{:.6g}, {:.6g}] leaves out the start value {:.6g}", bounds->lower / parameter.to_si,
                    bounds->upper / parameter.to_si, start / parameter.to_si),
        fmt::format("an interval around {} of [material]", parameter.key));
  }
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
  table->reject_unknown_keys();
}

}  // namespace

FitSettings read_fit(TomlTable& root, const model::Parameters<double>& material) {
  FitSettings settings;
  auto fit = root.table_if("fit");
  if (!fit) return settings;
  settings.oedometer = read_names(*fit, "oedometer", settings.oedometer);
  settings.slump = read_names(*fit, "slump", settings.slump);
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
  read_all_bounds(*fit, material, settings);
  read_all_priors(*fit, settings);
  fit->reject_unknown_keys();
  return settings;
}

}  // namespace isotach::datasets
