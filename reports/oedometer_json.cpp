// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests, noise, checks and assessment of an oedometer fit as JSON.
#include "reports/oedometer_json.hpp"

#include <algorithm>

#include "reports/estimates.hpp"
#include "reports/fit_json.hpp"
#include "reports/json_number.hpp"
#include "reports/run_info.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;
using nlohmann::ordered_json;

ordered_json optional_number(const std::optional<double>& value) {
  return value ? json_number(*value) : ordered_json(nullptr);
}

/// One JSON value of each item.
template <class Items, class F>
ordered_json array_of(const Items& items, F&& f) {
  ordered_json json = ordered_json::array();
  for (const auto& item : items) json.push_back(f(item));
  return json;
}

ordered_json tests_json(const datasets::Study& study, const OedometerFit& fit) {
  ordered_json json = ordered_json::array();
  for (std::size_t i = 0; i < fit.result.tests.size(); ++i) {
    const experiments::OedometerExperiment& experiment = *fit.experiments[i];
    const datasets::OedometerRecord& record = experiment.test().record;
    const experiments::OedometerStart& start = experiment.protocol().start;
    ordered_json test = test_json(fit.result.tests[i]);
    test["quantity"] = experiment.quantity();
    test["data"] = data_name(record.file, study.file);
    test["readings"] = record.rows.size();
    test["rows_dropped"] = array_of(record.notes, [](const datasets::RowNote& note) {
      return ordered_json{{"line", note.line}, {"what", note.what}};
    });
    test["columns_not_read"] = record.unknown_columns;
    test["stages_deduced"] = record.stages_deduced;
    test["start"] = {{"time_s", json_number(start.time)},
                     {"axial_strain", json_number(start.axial_strain)},
                     {"axial_stress_kPa", json_number(kPerPascal * start.axial_stress)},
                     {"void_ratio", json_number(start.void_ratio)}};
    test["primary_consolidation"] =
        array_of(experiment.protocol().consolidation, [&](const experiments::PrimaryConsolidation& one) {
          return ordered_json{{"step", one.step + 1},
                              {"load_kPa", json_number(kPerPascal * record.steps[one.step].load)},
                              {"end_s", optional_number(one.end)},
                              {"how", one.how}};
        });
    json.push_back(std::move(test));
  }
  return json;
}

/// The quantities that the tests are compared in, each once.
std::string quantities_of(const OedometerFit& fit) {
  std::vector<std::string> all;
  for (const auto& experiment : fit.experiments) {
    const std::string quantity(experiment->quantity());
    if (std::find(all.begin(), all.end(), quantity) == all.end()) all.push_back(quantity);
  }
  std::string text;
  for (const std::string& quantity : all) text += (text.empty() ? "" : "; ") + quantity;
  return text;
}

/// Every effect that is on, with its parameters in the units of their names.
ordered_json effects_json(const effects::Values<double>& values) {
  ordered_json json = ordered_json::object();
  for (const auto& one : values.chosen()) {
    ordered_json& effect = json[std::string(one.effect->name)] = ordered_json::object();
    for (std::size_t i = 0; i < one.effect->parameters.size(); ++i) {
      const auto& parameter = one.effect->parameters[i];
      effect[std::string(parameter.name)] = json_number(one.si[i] / parameter.to_si);
    }
  }
  return json;
}

ordered_json local_json(const calibration::LocalEstimate& estimate) {
  return {{"name", estimate.name},
          {"value", json_number(estimate.value)},
          {"std_error", json_number(estimate.std_error)},
          {"ci95", {json_number(estimate.ci95_lower), json_number(estimate.ci95_upper)}},
          {"verdict", calibration::name_of(estimate.verdict)},
          {"words", estimate.words}};
}

ordered_json noise_json(const calibration::ChannelNoise& channel) {
  return {{"test", channel.test},
          {"quantity", channel.quantity},
          {"values", channel.count},
          {"estimated", channel.estimated},
          {"level", json_number(channel.model.level)},
          {"floor_kPa", json_number(kPerPascal * channel.model.floor)},
          {"autocorrelation", json_number(channel.model.neighbours())},
          {"decay", json_number(channel.model.rho)},
          {"serial_share", json_number(channel.model.serial_share)},
          {"independent_values", json_number(channel.model.effective_count)},
          {"stated_level", json_number(channel.stated_level)},
          {"stated_floor_kPa", json_number(kPerPascal * channel.stated_floor)}};
}

ordered_json ljung_box_json(const calibration::LjungBox& test) {
  return {{"lags", test.lags},
          {"statistic", json_number(test.statistic)},
          {"p_value", json_number(test.p_value)}};
}

ordered_json check_json(const calibration::TestCheck& check) {
  ordered_json json{{"test", check.name}, {"held_out", check.held_out}};
  json["stages"] = array_of(check.stages, [](const calibration::StageCheck& stage) {
    return ordered_json{{"stage", stage.stage},
                        {"from_time_s", json_number(stage.from_time)},
                        {"to_time_s", json_number(stage.to_time)},
                        {"from_stress_kPa", json_number(kPerPascal * stage.from_stress)},
                        {"to_stress_kPa", json_number(kPerPascal * stage.to_stress)},
                        {"values", stage.count},
                        {"rms_over_noise", json_number(stage.rms_over_noise)},
                        {"mean_over_noise", json_number(stage.mean_over_noise)},
                        {"p_value", json_number(stage.p_value)},
                        {"missed", stage.misfit}};
  });
  json["runs"] = {{"runs", check.runs.runs},
                  {"expected", json_number(check.runs.expected)},
                  {"z", json_number(check.runs.z)},
                  {"p_value", json_number(check.runs.p_value)}};
  json["autocorrelation"] = json_number(check.autocorrelation);
  json["ljung_box"] = ljung_box_json(check.ljung_box);
  json["ljung_box_whitened"] = check.held_out ? ordered_json(nullptr) : ljung_box_json(check.whitened);
  json["patterned"] = check.patterned;
  return json;
}

ordered_json time_line_json(const calibration::TimeLine& line) {
  return {{"begin_s", json_number(line.begin)},
          {"duration_s", json_number(line.duration)},
          {"axial_stress_kPa", json_number(kPerPascal * line.stress)},
          {"slope", json_number(line.slope)}};
}

ordered_json constructions_json(const std::string& name, const calibration::Constructions& drawn) {
  ordered_json json{{"test", name}};
  json["virgin_slope"] = drawn.virgin ? json_number(-drawn.virgin->line.slope) : ordered_json(nullptr);
  json["virgin_rate_per_s"] = drawn.virgin ? json_number(drawn.virgin->rate) : ordered_json(nullptr);
  json["swelling_slopes"] =
      array_of(drawn.swelling, [](const calibration::Line& line) { return json_number(-line.slope); });
  json["yield_stress_casagrande_kPa"] =
      drawn.casagrande ? json_number(kPerPascal * drawn.casagrande->yield_stress) : ordered_json(nullptr);
  json["yield_stress_becker_kPa"] =
      drawn.becker ? json_number(kPerPascal * drawn.becker->yield_stress) : ordered_json(nullptr);
  json["rate_steps"] = array_of(drawn.rate_steps, [](const calibration::RateStep& step) {
    return ordered_json{{"rate_before_per_s", json_number(step.rate_before)},
                        {"rate_after_per_s", json_number(step.rate_after)},
                        {"logarithmic_step", json_number(step.logarithmic_step)},
                        {"I_v", json_number(step.I_v)}};
  });
  json["relaxations"] = array_of(drawn.relaxation, time_line_json);
  json["creep_lines"] = array_of(drawn.creep, time_line_json);
  return json;
}

ordered_json start_values_json(const OedometerFit& fit) {
  if (!fit.start) return nullptr;
  const auto value = [](const calibration::StartValue& read) {
    return ordered_json{{"value", optional_number(read.value)}, {"source", read.source}};
  };
  ordered_json json{{"e100", value(fit.start->e100)},
                    {"lambda", value(fit.start->lambda)},
                    {"kappa", value(fit.start->kappa)},
                    {"I_v", value(fit.start->I_v)}};
  json["tests"] = ordered_json::array();
  std::size_t next = 0;
  for (const auto& experiment : fit.experiments) {
    if (experiment->held_out() || next >= fit.start->tests.size()) continue;
    json["tests"].push_back(constructions_json(experiment->name(), fit.start->tests[next++]));
  }
  return json;
}

ordered_json profile_json(const calibration::FitResult& result, const calibration::Profile& profile) {
  const calibration::Coordinate& coordinate = result.coordinates[profile.coordinate];
  const auto quantity = [&](double x) { return json_number(quantity_at(coordinate, x)); };
  ordered_json json{{"parameter", quantity_key(coordinate)},
                    {"lower", quantity(profile.lower)},
                    {"upper", quantity(profile.upper)},
                    {"lower_end", calibration::name_of(profile.lower_end)},
                    {"upper_end", calibration::name_of(profile.upper_end)},
                    {"threshold", json_number(profile.threshold)}};
  json["points"] = array_of(profile.points, [&](const calibration::ProfilePoint& point) {
    return ordered_json{{"value", quantity(point.x)}, {"rise", json_number(point.delta)}};
  });
  return json;
}

ordered_json refit_json(const calibration::FitResult& result, const calibration::Refit& refit) {
  ordered_json json{{"what", refit.what}, {"parameters", nullptr}, {"shift_in_std_errors", nullptr}};
  if (refit.parameters) {
    json["parameters"] = ordered_json::object();
    for (const model::ParameterInfo& info : model::kParameterTable) {
      json["parameters"][std::string(info.key)] =
          json_number(in_key_unit(info.id, (*refit.parameters)[info.id]));
    }
    json["shift_in_std_errors"] = by_coordinate(result, refit.shift);
  }
  const bool predicted = refit.parameters && refit.failure.empty();
  json["rms_over_noise"] = predicted ? json_number(refit.rms_over_noise) : ordered_json(nullptr);
  json["failure"] = refit.failure.empty() ? ordered_json(nullptr) : ordered_json(refit.failure);
  return json;
}

ordered_json bootstrap_json(const calibration::FitResult& result, const calibration::Bootstrap& bootstrap) {
  const auto quantities = [&](const Eigen::VectorXd& x) {
    return quantities_json(result, {x.data(), static_cast<std::size_t>(x.size())});
  };
  return {{"samples", bootstrap.samples},
          {"failed", bootstrap.failed},
          {"mean_block_lengths", bootstrap.blocks},
          {"std_errors_of_coordinates",
           by_coordinate(result,
                         {bootstrap.std_error.data(), static_cast<std::size_t>(bootstrap.std_error.size())})},
          {"lower", quantities(bootstrap.lower)},
          {"upper", quantities(bootstrap.upper)}};
}

void add_assessment(ordered_json& json, const OedometerFit& fit) {
  for (const char* key : {"profiles", "multi_start", "global_searches", "without_test", "shifted_inputs",
                          "integrators", "bootstrap"}) {
    json[key] = nullptr;
  }
  if (!fit.assessment) return;
  const calibration::FitResult& result = fit.result;
  const calibration::OedometerAssessment& assessment = *fit.assessment;
  const auto refit = [&](const calibration::Refit& one) { return refit_json(result, one); };
  json["profiles"] = array_of(assessment.profiles, [&](const calibration::Profile& profile) {
    return profile_json(result, profile);
  });
  json["multi_start"] = {{"starts", assessment.multi_start.starts},
                         {"failed", assessment.multi_start.failed}};
  json["multi_start"]["moved_the_answer"] = assessment.multi_start.moved_the_answer;
  json["multi_start"]["clusters"] =
      array_of(assessment.multi_start.clusters, [&](const calibration::Cluster& cluster) {
        const std::span<const double> best(cluster.best.data(),
                                           static_cast<std::size_t>(cluster.best.size()));
        return ordered_json{{"count", cluster.count},
                            {"cost", json_number(cluster.cost)},
                            {"parameters", quantities_json(result, best)}};
      });
  json["global_searches"] =
      array_of(assessment.global_searches,
               [&](const calibration::OptimiserResult& search) { return route_json(result, search); });
  json["without_test"] = array_of(assessment.without_test, refit);
  json["shifted_inputs"] = array_of(assessment.shifted_inputs, refit);
  json["integrators"] = array_of(assessment.integrators, [](const calibration::IntegratorCheck& check) {
    const bool failed = !check.failure.empty();
    const ordered_json none(nullptr);
    return ordered_json{
        {"test", check.test},
        {"largest_difference_over_noise", failed ? none : json_number(check.largest_over_noise)},
        {"at_time_s", failed ? none : json_number(check.at_time)},
        {"failure", failed ? ordered_json(check.failure) : none}};
  });
  if (assessment.bootstrap) json["bootstrap"] = bootstrap_json(result, *assessment.bootstrap);
}

}  // namespace

ordered_json oedometer_fit_json(const datasets::Study& study, const OedometerFit& fit) {
  ordered_json json = fit_json(fit.result);
  json["quantity"] = quantities_of(fit);
  json["degrees_of_freedom"] = json_number(fit.result.uncertainty.degrees);
  json["tests"] = tests_json(study, fit);
  std::vector<calibration::LocalEstimate> starts = fit.result.local_estimates;
  std::erase_if(starts,
                [](const calibration::LocalEstimate& estimate) { return estimate.effect.has_value(); });
  json["starts"] = array_of(starts, local_json);
  json["effects"] = effects_json(fit.effects);
  json["noise"] = array_of(fit.noise.channels, noise_json);
  json["checks"] = array_of(fit.checks, check_json);
  json["start_values"] = start_values_json(fit);
  add_assessment(json, fit);
  json["assumptions"] = study.assumptions;
  return json;
}

}  // namespace isotach::reports
