// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/discovery_parts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/json_number.hpp"
#include "reports/number.hpp"

namespace isotach::reports {

using nlohmann::ordered_json;

namespace {

std::string three(double value) {
  return format_number(value, 3);
}

/// Calls f(parameter, value in the unit of files) for each parameter.
template <class F>
void for_parameters(const EffectList& added, const effects::Values<double>& values, F&& f) {
  for (const effects::Effect* effect : added) {
    for (std::size_t k = 0; k < effect->parameters.size(); ++k) {
      const effects::ParameterRef parameter{effect, k};
      f(parameter, values[parameter] / effect->parameters[k].to_si);
    }
  }
}

}  // namespace

std::string described(const EffectList& added) {
  std::string words;
  for (const effects::Effect* effect : added) {
    words += fmt::format("{}{} ({})", words.empty() ? "" : " and ", effect->name, effect->meaning);
  }
  return words;
}

std::string values_of(const EffectList& added, const effects::Values<double>& values) {
  std::string words;
  for_parameters(added, values, [&](const effects::ParameterRef& parameter, double value) {
    words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", parameter.info().name, three(value));
  });
  return words;
}

std::string intervals_words(const std::vector<discovery::AmplitudeInterval>& amplitudes) {
  std::string words;
  for (const discovery::AmplitudeInterval& one : amplitudes) {
    const effects::EffectParameter& parameter = one.effect->parameters[0];
    const auto end = [&](double value, calibration::ProfileEnd how) {
      const std::string number = three(value / parameter.to_si);
      return how == calibration::ProfileEnd::crossed ? number : fmt::format("{} ({})", number, name_of(how));
    };
    words += fmt::format("{}{} {} to {}", words.empty() ? "" : ", ", parameter.name,
                         end(one.lower, one.lower_end), end(one.upper, one.upper_end));
  }
  if (words.empty()) return words;
  return fmt::format(" ({:.0f} % interval: {})", 100.0 * discovery::kIntervalLevel, words);
}

std::string gap_words(const GapNouns& nouns, const discovery::Gap& before, const discovery::Gap& after,
                      double best_wrong, double smoother) {
  std::string words = fmt::format("{} shrinks from {} to {} times {}", nouns.gap, three(before.fitted),
                                  three(after.fitted), nouns.noise);
  if (std::isfinite(after.held_out)) {
    words += fmt::format(", on tests held out from {} to {}", three(before.held_out), three(after.held_out));
  }
  if (std::isfinite(best_wrong)) words += fmt::format("; the next explanation reaches {}", three(best_wrong));
  return words + fmt::format(", a curve drawn through the {} {}.", nouns.data, three(smoother));
}

std::string next_words(const discovery::NextExperiment& next) {
  return fmt::format(
      "Next test: {} {} would part the first two by {} standard deviations (repeated as it was made: {}).",
      next.test, next.change, three(next.separation), three(next.now));
}

void add_conditions(Page& page, const std::vector<discovery::Condition>& conditions) {
  if (conditions.empty()) return;
  Table table{.caption = "Conditions of a name.", .header = {"condition", "holds"}};
  for (const discovery::Condition& condition : conditions) {
    table.rows.push_back({condition.text, condition.holds ? "yes" : "no"});
  }
  page.table(std::move(table));
}

void add_not_tried(Page& page, const std::vector<std::pair<const effects::Effect*, std::string>>& not_tried) {
  if (not_tried.empty()) return;
  Table table{.caption = "Effects that were not fitted.", .header = {"effect", "why"}};
  for (const auto& [effect, why] : not_tried) table.rows.push_back({std::string(effect->name), why});
  page.table(std::move(table));
}

ordered_json names_json(const EffectList& added) {
  ordered_json names = ordered_json::array();
  for (const effects::Effect* effect : added) names.push_back(std::string(effect->name));
  return names;
}

ordered_json values_json(const EffectList& added, const effects::Values<double>& values) {
  ordered_json json = ordered_json::object();
  for_parameters(added, values, [&](const effects::ParameterRef& parameter, double value) {
    json[std::string(parameter.effect->name)][std::string(parameter.info().name)] = json_number(value);
  });
  return json;
}

ordered_json intervals_json(const std::vector<discovery::AmplitudeInterval>& amplitudes) {
  ordered_json json = ordered_json::object();
  for (const discovery::AmplitudeInterval& one : amplitudes) {
    const effects::EffectParameter& parameter = one.effect->parameters[0];
    json[std::string(one.effect->name)] = {{"parameter", std::string(parameter.name)},
                                           {"lower", json_number(one.lower / parameter.to_si)},
                                           {"upper", json_number(one.upper / parameter.to_si)},
                                           {"lower_end", std::string(name_of(one.lower_end))},
                                           {"upper_end", std::string(name_of(one.upper_end))},
                                           {"level", json_number(discovery::kIntervalLevel)}};
  }
  return json;
}

ordered_json gap_json(const discovery::Gap& before, const discovery::Gap& after, double best_wrong,
                      double smoother) {
  return {{"before", json_number(before.fitted)},
          {"after", json_number(after.fitted)},
          {"held_out_before", json_number(before.held_out)},
          {"held_out_after", json_number(after.held_out)},
          {"best_wrong_after", json_number(best_wrong)},
          {"smoother_after", json_number(smoother)}};
}

ordered_json conditions_json(const std::vector<discovery::Condition>& conditions) {
  ordered_json json = ordered_json::array();
  for (const discovery::Condition& condition : conditions) {
    json.push_back({{"condition", condition.text}, {"holds", condition.holds}});
  }
  return json;
}

ordered_json next_json(const std::optional<discovery::NextExperiment>& next) {
  if (!next) return nullptr;
  return {{"test", next->test},
          {"change", next->change},
          {"separation", json_number(next->separation)},
          {"separation_now", json_number(next->now)}};
}

}  // namespace isotach::reports
