// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A discovery as result.json.
#include "reports/discovery_parts.hpp"
#include "reports/discovery_report.hpp"
#include "reports/json_number.hpp"
#include "reports/result_head.hpp"
#include "reports/slump_discovery_report.hpp"
#include "reports/wandering_section.hpp"

namespace isotach::reports {
namespace {

using nlohmann::ordered_json;

ordered_json trial_json(const discovery::Trial& trial) {
  return {{"effects", names_json(trial.candidate.added)},
          {"effect_parameters", values_json(trial.candidate.added, trial.candidate.fit.effects)},
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
  const discovery::Trial& answer = found.answer();
  json["effects"] = names_json(answer.candidate.added);
  json["equivalent"] = ordered_json::array();
  for (const std::size_t k : found.equivalent) {
    json["equivalent"].push_back(names_json(found.trials[k].candidate.added));
  }
  json["effect_parameters"] = values_json(answer.candidate.added, answer.candidate.fit.effects);
  json["amplitude_intervals"] = intervals_json(found.amplitudes);
  json["gap"] = gap_json(found.base.gap, answer.gap, found.best_wrong, found.smoother);
  json["p_value"] = json_number(found.p_value);
  json["disagreement"] = ordered_json::array();
  for (const discovery::Disagreement& place : found.disagreement) {
    json["disagreement"].push_back(
        {{"experiment", place.test},
         {"held_out", place.held_out},
         {"stage", place.stage.stage},
         {"from", json_number(place.stage.from_time)},
         {"to", json_number(place.stage.to_time)},
         {"rms_over_noise", json_number(place.stage.rms_over_noise)},
         {"score", json_number(place.score)},
         {"explained", place.explained ? json_number(*place.explained) : ordered_json(nullptr)}});
  }
  json["wandering"] = wandering_json(found.wandering);
  json["conditions"] = conditions_json(found.conditions);
  json["trials"] = ordered_json::array();
  for (const discovery::Trial& trial : found.trials) json["trials"].push_back(trial_json(trial));
  json["next_test"] = next_json(found.next);
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
