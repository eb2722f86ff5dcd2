// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fits and slumps of result.json.
#include "reports/result_json.hpp"

#include "reports/estimates.hpp"
#include "reports/fit_json.hpp"
#include "reports/json_number.hpp"
#include "reports/oedometer_json.hpp"
#include "reports/result_head.hpp"
#include "reports/slump_budgets.hpp"
#include "reports/slump_json.hpp"

namespace isotach::reports {
namespace {

using nlohmann::ordered_json;

ordered_json slump_fit_json(const datasets::Study& study, const calibration::SlumpFit& fit) {
  ordered_json json = fit_json(fit.result);
  json["quantity"] = "distance between outlines (m)";
  json["tests"] = ordered_json::array();
  for (std::size_t i = 0; i < fit.result.tests.size(); ++i) {
    const calibration::SlumpComparison& comparison = fit.comparisons[i];
    const datasets::SlumpTest& read = comparison.experiment->test();
    ordered_json test = test_json(fit.result.tests[i]);
    test["rms_mm"] = json_number(1e3 * comparison.rms);
    test["rms_mould_gone_mm"] = json_number(1e3 * comparison.rms_mould_gone);
    test["data"] = data_name(read.data, study.file);
    test["simulation"] = slump_json(read.best_setup(), comparison.simulation);
    json["tests"].push_back(std::move(test));
  }
  json["routes"][0]["simulations"] = fit.result.main.simulations;
  for (const calibration::OptimiserResult& route : fit.other_routes) {
    json["routes"].push_back(route_json(fit.result, route));
    json["routes"].back()["simulations"] = route.simulations;
  }
  json["rms_mould_gone_mm"] = json_number(1e3 * fit.rms_mould_gone);
  json["reference_numerics"] = nullptr;
  if (fit.corrections.any()) {
    json["reference_numerics"] = {{"correction_mm", json_number(1e3 * fit.corrections.outline)},
                                  {"correction_lifting_mm", json_number(1e3 * fit.corrections.lifting)},
                                  {"tests_failed", fit.corrections.failed}};
  }
  json["simulations"] = fit.runs.total();
  json["simulations_by_status"] = ordered_json::object();
  for (std::size_t i = 0; i < mpm::kRunStatusCount; ++i) {
    const auto status = static_cast<mpm::RunStatus>(i);
    if (status == mpm::RunStatus::interrupted) continue;  // then there is no result
    json["simulations_by_status"][std::string(name_of(status))] = fit.runs[status];
  }
  json["evaluations_failed"] = fit.result.main.failed_evaluations;
  json["assumptions"] = study.assumptions;
  return json;
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more, std::string_view from) {
  for (const std::string& text : more) all.push_back(std::string(from) + text);
}

}  // namespace

ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                         const calibration::OedometerFit& fit) {
  ordered_json json = result_head(run, "ok", fit.result.warnings);
  json.update(oedometer_fit_json(study, fit));
  return json;
}

ordered_json result_json(const RunInfo& run, const datasets::Study& study, const calibration::SlumpFit& fit) {
  ordered_json json = result_head(run, "ok", fit.result.warnings);
  json.update(slump_fit_json(study, fit));
  return json;
}

ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                         const calibration::Calibration& calibration) {
  std::vector<std::string> warnings;
  append(warnings, calibration.oedometer.result.warnings, "oedometer fit: ");
  append(warnings, calibration.slump.result.warnings, "slump fit: ");
  ordered_json json = result_head(run, "ok", warnings);
  json["parameters"] = parameters_json(combined_estimates(calibration));
  json["parameters"].update(shared_estimates_json(calibration.oedometer.result.local_estimates));
  json["adequate"] = calibration.oedometer.result.adequate && calibration.slump.result.adequate;
  json["settled"] = calibration.settled;
  json["rounds"] = ordered_json::array();
  const auto values = [](const model::Parameters<double>& parameters) {
    ordered_json by_key = ordered_json::object();
    for (const model::ParameterInfo& info : model::kParameterTable) {
      by_key[std::string(info.key)] = json_number(in_key_unit(info.id, parameters[info.id]));
    }
    return by_key;
  };
  for (const calibration::CalibrationRound& round : calibration.rounds) {
    json["rounds"].push_back(
        {{"after_oedometer", values(round.after_oedometer)}, {"after_slump", values(round.after_slump)}});
  }
  json["first_oedometer_parameters"] = parameters_json(calibration.first_oedometer.result.estimates);
  json["fit_oedometer"] = oedometer_fit_json(study, calibration.oedometer);
  json["fit_slump"] = slump_fit_json(study, calibration.slump);
  if (calibration.joint) {
    const calibration::JointFit& joint = *calibration.joint;
    json["joint"] = {{"parameters", parameters_json(joint.result.estimates)},
                     {"oedometer_cost", json_number(joint.oedometer_cost)},
                     {"oedometer_cost_alone", json_number(joint.oedometer_least)},
                     {"slump_cost", json_number(joint.slump_cost)},
                     {"slump_cost_alone", json_number(joint.slump_least)},
                     {"rise", json_number(joint.rise)},
                     {"p_value", json_number(joint.p_value)}};
  }
  return json;
}

ordered_json result_json(const RunInfo& run, const datasets::SlumpFile& test,
                         const mpm::SlumpResult& result) {
  ordered_json json = result_head(run, "ok", slump_warnings(result));
  json.update(slump_json(test.setup, result));
  json["assumptions"] = test.assumptions;
  return json;
}

ordered_json failure_json(const RunInfo& run, const calibration::FitFailure& failure) {
  ordered_json json = result_head(run, failure.interrupted ? "interrupted" : "failed", {});
  json["failure"] = failure.message;
  return json;
}

ordered_json failure_json(const RunInfo& run, const mpm::SlumpFailure& failure) {
  using Kind = mpm::SlumpFailure::Kind;
  ordered_json json = result_head(run, failure.kind == Kind::interrupted ? "interrupted" : "failed", {});
  json["failure"] = failure.message;
  json["time_s"] = json_number(failure.time);
  // only what went astray has a place
  const bool placed =
      failure.kind == Kind::left_grid || failure.kind == Kind::left_slab || failure.kind == Kind::not_finite;
  json["r_mm"] = placed ? json_number(1e3 * failure.r) : ordered_json(nullptr);
  json["z_mm"] = placed ? json_number(1e3 * failure.z) : ordered_json(nullptr);
  return json;
}

}  // namespace isotach::reports
