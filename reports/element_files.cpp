// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An element test as JSON and CSV.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reports/element_figures.hpp"
#include "reports/element_report.hpp"
#include "reports/json_number.hpp"
#include "reports/result_head.hpp"

namespace isotach::reports {
namespace {

using nlohmann::ordered_json;

std::vector<std::string> stage_names(const datasets::ElementFile& test, const ElementCurve& curve) {
  std::vector<std::string> names;
  for (const std::size_t stage : curve.stage) names.push_back(test.stages[stage].name);
  return names;
}

void add_tensor(std::vector<CsvColumn>& columns, const char* name, const char* unit,
                const std::array<ElementCurve::Column, 6>& tensor) {
  for (std::size_t i = 0; i < 6; ++i) {
    columns.push_back({fmt::format("{}_{}{}", name, kComponentNames[i], unit), tensor[i]});
  }
}

bool has_fabric(const ElementCurve& curve) {
  return std::any_of(curve.omega.begin(), curve.omega.end(), [](const ElementCurve::Column& component) {
    return component.front() != 0.0 || changes(component, 0.0);
  });
}

void write_figure(OutputDirectory& output, const ElementFigure& drawn) {
  std::vector<std::string> names;
  ElementCurve::Column x;
  ElementCurve::Column y;
  for (const Series& series : drawn.figure.series) {
    names.insert(names.end(), series.x.size(), series.label);
    x.insert(x.end(), series.x.begin(), series.x.end());
    y.insert(y.end(), series.y.begin(), series.y.end());
  }
  output.write_csv(
      fmt::format("curves/{}.csv", drawn.name),
      std::vector<CsvColumn>{
          {"curve", std::move(names)}, {drawn.x_key, std::move(x)}, {drawn.y_key, std::move(y)}});
}

ordered_json tensor_json(const std::array<ElementCurve::Column, 6>& tensor, std::size_t row) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = 0; i < 6; ++i) json[std::string(kComponentNames[i])] = json_number(tensor[i][row]);
  return json;
}

ordered_json state_json(const ElementCurve& curve, std::size_t row) {
  ordered_json json{{"time_s", json_number(curve.time[row])},
                    {"strain", tensor_json(curve.strain, row)},
                    {"stress_kPa", tensor_json(curve.stress, row)},
                    {"void_ratio", json_number(curve.void_ratio[row])},
                    {"ocr", json_number(curve.ocr[row])},
                    {"volumetric_strain", json_number(curve.volumetric_strain[row])},
                    {"p_kPa", json_number(curve.p[row])},
                    {"q_kPa", json_number(curve.q[row])},
                    {"preconsolidation_pressure_kPa", json_number(curve.p_B[row])}};
  if (has_fabric(curve)) json["omega"] = tensor_json(curve.omega, row);
  return json;
}

void add_failure(ordered_json& json, const datasets::ElementFile& test, const ElementRun& result) {
  const integrators::ElementFailure& failure = *result.failure;
  json["failure"] = failure_text(test, result);
  json["stage"] = test.stages[failure.stage].name;
  json["stage_number"] = failure.stage + 1;
  double begin = 0.0;
  for (std::size_t i = 0; i < failure.stage; ++i) begin += test.stages[i].increment.duration;
  json["time_s"] = json_number(failure.time);
  json["time_in_stage_s"] = json_number(failure.time - begin);
  const ElementCurve at(
      test, {{failure.time, failure.stage, model::Mandel<double>::Zero(), failure.failure.last_state,
              model::Law<double>(test.material).overconsolidation_ratio(failure.failure.last_state)}});
  json["last_state"] = {{"stress_kPa", tensor_json(at.stress, 0)},
                        {"void_ratio", json_number(at.void_ratio[0])},
                        {"ocr", json_number(at.ocr[0])},
                        {"p_kPa", json_number(at.p[0])},
                        {"q_kPa", json_number(at.q[0])}};
}

}  // namespace

void write_curves(OutputDirectory& output, const datasets::ElementFile& test, const ElementRun& result) {
  const ElementCurve curve(test, result.rows);
  const std::vector<std::string> stages = stage_names(test, curve);
  std::vector<CsvColumn> columns{{"time_s", curve.time}, {"stage", stages}};
  add_tensor(columns, "strain", "", curve.strain);
  add_tensor(columns, "stress", "_kPa", curve.stress);
  columns.push_back({"void_ratio", curve.void_ratio});
  columns.push_back({"ocr", curve.ocr});
  output.write_csv("curve.csv", columns);
  if (has_fabric(curve)) {
    std::vector<CsvColumn> fabric{{"time_s", curve.time}, {"stage", stages}};
    add_tensor(fabric, "omega", "", curve.omega);
    output.write_csv("fabric.csv", fabric);
  }
  if (curve.size() < 2) return;
  for (const ElementFigures& group : element_figures(test, curve)) {
    for (const ElementFigure& drawn : group.figures) write_figure(output, drawn);
  }
}

ordered_json result_json(const RunInfo& run, const datasets::ElementFile& test, const ElementRun& result) {
  const std::string_view status = !result.failure               ? "ok"
                                  : result.failure->interrupted ? "interrupted"
                                                                : "failed";
  ordered_json json = result_head(run, status);
  if (result.failure) add_failure(json, test, result);
  json["integrator"] = integrators::name(result.method);
  json["tolerance"] = json_number(result.tolerance);
  const ElementCurve curve(test, result.rows);
  json["rows"] = curve.size();
  json["start"] = state_json(curve, 0);
  json["stages"] = ordered_json::array();
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (i + 1 < curve.size() && curve.stage[i + 1] == curve.stage[i]) continue;
    const integrators::Stage& stage = test.stages[curve.stage[i]];
    json["stages"].push_back({{"name", stage.name},
                              {"duration_s", json_number(stage.increment.duration)},
                              {"control", control_text(stage)},
                              {"end", state_json(curve, i)}});
  }
  json["end"] = state_json(curve, curve.size() - 1);
  const integrators::Statistics& cost = result.rows.back().statistics;
  json["cost"] = {{"steps", cost.accepted},
                  {"rejected", cost.rejected},
                  {"evaluations", cost.evaluations},
                  {"jacobians", cost.jacobians}};
  return json;
}

}  // namespace isotach::reports
