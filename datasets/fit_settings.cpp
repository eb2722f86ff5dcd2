// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [fit] and [fit.bounds] of a study: implementation.
#include "datasets/fit_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

  if (auto table = fit->table_if("bounds")) {
    for (const ParameterInfo& parameter : model::kParameterTable) {
      auto& bounds = settings.bounds[static_cast<std::size_t>(parameter.id)];
      bounds = read_bounds(*table, parameter);
      const auto is_this = [&](ParameterId id) { return id == parameter.id; };
      const bool fitted = std::any_of(settings.oedometer.begin(), settings.oedometer.end(), is_this) ||
                          std::any_of(settings.slump.begin(), settings.slump.end(), is_this);
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
  fit->reject_unknown_keys();
  return settings;
}

}  // namespace isotach::datasets
