// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A discovery as result.json.
#include "reports/discovery_report.hpp"
#include "reports/json_number.hpp"
#include "reports/result_head.hpp"
#include "reports/slump_discovery_report.hpp"

namespace isotach::reports {
namespace {

using nlohmann::ordered_json;

ordered_json names_of(const discovery::Candidate& candidate) {
  ordered_json names = ordered_json::array();
  for (const effects::Effect* effect : candidate.added) names.push_back(std::string(effect->name));
  return names;
}

ordered_json parameters_of(const discovery::Candidate& candidate) {
  ordered_json json = ordered_json::object();
  for (const effects::Effect* effect : candidate.added) {
    ordered_json values = ordered_json::object();
    for (std::size_t k = 0; k < effect->parameters.size(); ++k) {
      const effects::ParameterRef parameter{effect, k};
      values[std::string(effect->parameters[k].name)] =
          json_number(candidate.fit.effects[parameter] / effect->parameters[k].to_si);
    }
    json[std::string(effect->name)] = std::move(values);
  }
  return json;
}

ordered_json trial_json(const discovery::Trial& trial) {
  return {{"effects", names_of(trial.candidate)},
          {"effect_parameters", parameters_of(trial.candidate)},
          {"bic", json_number(trial.candidate.bic)},
          {"chi_squared", json_number(trial.candidate.chi_squared)},
          {"gap", json_number(trial.gap.fitted)},
          {"held_out_gap", json_number(trial.gap.held_out)},
          {"adequate", trial.adequate}};
}

}  // namespace

ordered_json discovery_json(const discovery::Discovery& found) {
  ordered_json json;
  json["verdict"] = std::string(name_of(found.verdict));
  const discovery::Trial* named = found.chosen ? &found.trials[*found.chosen] : nullptr;
  json["effects"] = named != nullptr ? names_of(named->candidate) : ordered_json::array();
  json["equivalent"] = ordered_json::array();
  for (const std::size_t k : found.equivalent)
    json["equivalent"].push_back(names_of(found.trials[k].candidate));
  json["effect_parameters"] = named != nullptr ? parameters_of(named->candidate) : ordered_json::object();
  const discovery::Gap& before = found.base.gap;
  json["gap"] = {
      {"before", json_number(before.fitted)},
      {"after", json_number(named != nullptr ? named->gap.fitted : before.fitted)},
      {"held_out_before", json_number(before.held_out)},
      {"held_out_after", json_number(named != nullptr ? named->gap.held_out : before.held_out)},
      {"best_wrong_after", found.trials.size() > 1 ? json_number(found.best_wrong) : ordered_json(nullptr)},
      {"smoother_after", json_number(found.smoother)}};
  json["p_value"] = json_number(found.p_value);
  json["disagreement"] = ordered_json::array();
  for (const discovery::Disagreement& place : found.disagreement) {
    json["disagreement"].push_back({{"experiment", place.test},
                                    {"held_out", place.held_out},
                                    {"stage", place.stage.stage},
                                    {"from", json_number(place.stage.from_time)},
                                    {"to", json_number(place.stage.to_time)},
                                    {"rms_over_noise", json_number(place.stage.rms_over_noise)},
                                    {"score", json_number(place.score)}});
  }
  json["conditions"] = ordered_json::array();
  for (const discovery::Condition& condition : found.conditions) {
    json["conditions"].push_back({{"condition", condition.text}, {"holds", condition.holds}});
  }
  json["trials"] = ordered_json::array();
  for (const discovery::Trial& trial : found.trials) json["trials"].push_back(trial_json(trial));
  json["next_test"] = nullptr;
  if (found.next) {
    json["next_test"] = {{"test", found.next->test},
                         {"change", found.next->change},
                         {"separation", json_number(found.next->separation)},
                         {"separation_now", json_number(found.next->now)}};
  }
  return json;
}

ordered_json result_json(const RunInfo& run, const datasets::Study& study, const Discoveries& found) {
  ordered_json json = result_head(run, "ok", {});
  const ordered_json oedometer = found.oedometer ? discovery_json(*found.oedometer) : ordered_json(nullptr);
  const ordered_json slump = found.slump ? discovery_json(*found.slump) : ordered_json(nullptr);
  if (!study.oedometer_tests.empty() && !study.slump_tests.empty()) {
    json["oedometer"] = oedometer;
    json["slump"] = slump;
  } else {
    json.update(found.oedometer ? oedometer : slump);
  }
  return json;
}

}  // namespace isotach::reports
