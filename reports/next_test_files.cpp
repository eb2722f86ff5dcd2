// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which test to make next, for programs.
#include "reports/json_number.hpp"
#include "reports/next_test_report.hpp"
#include "reports/result_head.hpp"

namespace isotach::reports {
namespace {

using calibration::CandidateRating;
using calibration::NextTest;
using calibration::Outlook;
using nlohmann::ordered_json;

ordered_json outlook_json(const Outlook& outlook) {
  return {{"std_error_ln_I_v", json_number(outlook.first)},
          {"std_error_C_1", json_number(outlook.second)},
          {"correlation", json_number(outlook.correlation)},
          {"ln_det", json_number(outlook.log_det)}};
}

ordered_json candidate_json(const NextTest& next, const CandidateRating& candidate) {
  ordered_json json;
  json["name"] = candidate.name;
  json["kind"] = candidate.slump ? "slump" : "oedometer";
  json["programme"] = candidate.programme.empty() ? ordered_json(nullptr) : ordered_json(candidate.programme);
  if (!candidate.failure.empty()) {
    json["failure"] = candidate.failure;
    return json;
  }
  json["gain"] = json_number(calibration::gain(next.present, candidate.with_present));
  json["values"] = candidate.values;
  json["directions_held"] = candidate.directions;
  json["with_study"] = outlook_json(candidate.with_present);
  json["with_study_others_known"] = outlook_json(candidate.with_present_held);
  json["alone"] = outlook_json(candidate.alone);
  return json;
}

ordered_json programmes_json(const NextTest& next) {
  ordered_json all = ordered_json::array();
  for (const calibration::ProgrammeRating& programme : next.programmes) {
    ordered_json json;
    json["name"] = programme.name;
    json["alone"] = outlook_json(programme.alone);
    json["with_study"] = outlook_json(programme.with_present);
    json["tests"] = ordered_json::array();
    for (std::size_t k = 0; k < programme.tests.size(); ++k) {
      json["tests"].push_back({{"name", next.candidates[programme.tests[k]].name},
                               {"programme_without", outlook_json(programme.without[k])}});
    }
    all.push_back(std::move(json));
  }
  return all;
}

}  // namespace

ordered_json result_json(const RunInfo& run, const datasets::Study& /*study*/, const NextTest& next) {
  ordered_json json = result_head(run, "ok", next.warnings);
  const std::vector<std::size_t> order = by_gain(next);
  json["next_test"] =
      order.empty() ? ordered_json(nullptr) : ordered_json(next.candidates[order.front()].name);
  json["parameters_found"] = ordered_json::array();
  for (const calibration::Coordinate& coordinate : next.coordinates) {
    json["parameters_found"].push_back(coordinate.name);
  }
  json["gauge_rate_per_s"] =
      next.reference_rate > 0.0 ? json_number(next.reference_rate) : ordered_json(nullptr);
  json["present"] = outlook_json(next.present);
  json["present_others_known"] = outlook_json(next.present_held);
  json["tests"] = ordered_json::array();
  for (const calibration::HeldTest& test : next.tests) {
    json["tests"].push_back({{"name", test.name},
                             {"values", test.values},
                             {"directions_held", test.directions},
                             {"alone", outlook_json(test.alone)},
                             {"without", outlook_json(test.without)}});
  }
  json["candidates"] = ordered_json::array();
  for (const std::size_t i : order) json["candidates"].push_back(candidate_json(next, next.candidates[i]));
  for (const CandidateRating& candidate : next.candidates) {
    if (!candidate.failure.empty()) json["candidates"].push_back(candidate_json(next, candidate));
  }
  json["programmes"] = programmes_json(next);
  json["sequence"] = ordered_json::array();
  for (const calibration::SequenceStep& step : next.sequence) {
    json["sequence"].push_back(
        {{"name", next.candidates[step.candidate].name}, {"after", outlook_json(step.after)}});
  }
  json["pair"] = nullptr;
  if (next.pair) {
    json["pair"] = {
        {"names", {next.candidates[next.pair->first].name, next.candidates[next.pair->second].name}},
        {"after", outlook_json(next.after_pair)}};
  }
  json["simulations"] = next.runs.total();
  return json;
}

void write_curves(OutputDirectory& output, const NextTest& next) {
  std::vector<std::string> names;
  std::vector<std::string> kinds;
  std::vector<double> gains, I_v, C_1, correlation, alone_I_v, alone_C_1, held_I_v, held_C_1, values,
      directions;
  for (const std::size_t i : by_gain(next)) {
    const CandidateRating& candidate = next.candidates[i];
    names.push_back(candidate.name);
    kinds.emplace_back(candidate.slump ? "slump" : "oedometer");
    gains.push_back(calibration::gain(next.present, candidate.with_present));
    I_v.push_back(candidate.with_present.first);
    C_1.push_back(candidate.with_present.second);
    correlation.push_back(candidate.with_present.correlation);
    alone_I_v.push_back(candidate.alone.first);
    alone_C_1.push_back(candidate.alone.second);
    held_I_v.push_back(candidate.with_present_held.first);
    held_C_1.push_back(candidate.with_present_held.second);
    values.push_back(static_cast<double>(candidate.values));
    directions.push_back(candidate.directions);
  }
  const std::vector<CsvColumn> table{{"candidate", names},
                                     {"kind", kinds},
                                     {"gain", gains},
                                     {"std_error_ln_I_v", I_v},
                                     {"std_error_C_1", C_1},
                                     {"correlation", correlation},
                                     {"alone_std_error_ln_I_v", alone_I_v},
                                     {"alone_std_error_C_1", alone_C_1},
                                     {"others_known_std_error_ln_I_v", held_I_v},
                                     {"others_known_std_error_C_1", held_C_1},
                                     {"values", values},
                                     {"directions_held", directions}};
  output.write_csv("candidates.csv", table);
  std::vector<std::string> ellipse_names;
  std::vector<double> x;
  std::vector<double> y;
  for (const Ellipse& ellipse : ellipses_of(next)) {
    ellipse_names.insert(ellipse_names.end(), ellipse.I_v.size(), ellipse.name);
    x.insert(x.end(), ellipse.I_v.begin(), ellipse.I_v.end());
    y.insert(y.end(), ellipse.C_1.begin(), ellipse.C_1.end());
  }
  const std::vector<CsvColumn> curves{{"region", ellipse_names}, {"I_v", x}, {"C_1", y}};
  output.write_csv("curves/ellipses.csv", curves);
}

}  // namespace isotach::reports
