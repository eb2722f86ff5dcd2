// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fits and slumps of result.json.
#include "reports/result_json.hpp"

#include "reports/estimates.hpp"
#include "reports/json_number.hpp"
#include "reports/result_head.hpp"
#include "reports/slump_json.hpp"

namespace isotach::reports {
namespace {

using nlohmann::ordered_json;

ordered_json parameters_json(const std::vector<calibration::ParameterEstimate>& estimates) {
  ordered_json json = ordered_json::object();
  for (const calibration::ParameterEstimate& si : estimates) {
    const calibration::ParameterEstimate estimate = in_key_unit(si);
    const model::ParameterInfo& info = model::info(si.id);
    json[std::string(info.name)] = {
        {"value", json_number(estimate.value)},
        {"unit", info.unit},
        {"std_error", json_number(estimate.std_error)},
        {"ci95", ordered_json::array({json_number(estimate.ci95_lower), json_number(estimate.ci95_upper)})},
        {"verdict", calibration::name_of(estimate.verdict)}};
  }
  return json;
}

/// One number for each coordinate, under its name.
template <class Vector>
ordered_json by_coordinate(const calibration::FitResult& result, const Vector& numbers) {
  ordered_json json = ordered_json::object();
  for (std::size_t k = 0; k < result.free.size(); ++k) {
    json[coordinate_name(result.free[k])] = json_number(numbers[static_cast<Eigen::Index>(k)]);
  }
  return json;
}

ordered_json correlation_json(const calibration::FitResult& result) {
  ordered_json json;
  json["names"] = ordered_json::array();
  for (const model::ParameterId id : result.free) json["names"].push_back(coordinate_name(id));
  json["matrix"] = ordered_json::array();
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index j = 0; j < result.correlation.cols(); ++j) {
      row.push_back(json_number(result.correlation(i, j)));
    }
    json["matrix"].push_back(std::move(row));
  }
  return json;
}

ordered_json gauge_json(const calibration::FitResult& result) {
  const bool rated = result.gauge.kind == datasets::Gauge::crs_rate;
  return {{"kind", gauge_name(result.gauge.kind)},
          {"reference_rate_per_s", rated ? json_number(result.gauge.reference_rate) : ordered_json(nullptr)},
          {"sentence", gauge_sentence(result)}};
}

ordered_json route_json(const calibration::FitResult& result, const calibration::OptimiserResult& route) {
  ordered_json parameters = ordered_json::object();
  for (std::size_t k = 0; k < result.free.size(); ++k) {
    const model::ParameterInfo& info = model::info(result.free[k]);
    parameters[std::string(info.key)] = json_number(parameter_of_coordinate(info.id, route.coordinates[k]));
  }
  return {{"route", route.route},
          {"converged", route.converged},
          {"termination", route.termination},
          {"parameters", std::move(parameters)},
          {"cost", json_number(route.cost)},
          {"evaluations", route.evaluations},
          {"failed_evaluations", route.failed_evaluations}};
}

/// What both fits have in common.
ordered_json fit_json(const calibration::FitResult& result) {
  ordered_json json;
  json["parameters"] = parameters_json(result.estimates);
  json["adequate"] = result.adequate;
  json["gauge"] = gauge_json(result);
  json["null_directions"] = ordered_json::array();
  for (const Eigen::VectorXd& direction : result.uncertainty.null_directions) {
    json["null_directions"].push_back(by_coordinate(result, direction));
  }
  json["correlation"] = correlation_json(result);
  json["error_inflation"] = json_number(result.uncertainty.inflation);
  json["residual_autocorrelation"] = json_number(result.uncertainty.autocorrelation);
  json["routes"] = ordered_json::array({route_json(result, result.main)});
  json["disagreement_in_std_errors"] = nullptr;
  if (result.check) {
    json["routes"].push_back(route_json(result, *result.check));
    json["disagreement_in_std_errors"] = json_number(result.disagreement);
  }
  return json;
}

ordered_json test_json(const calibration::TestSummary& test) {
  return {{"name", test.name},
          {"held_out", test.held_out},
          {"values", test.values},
          {"rms", json_number(test.rms)},
          {"rms_over_noise", json_number(test.rms_over_noise)}};
}

ordered_json oedometer_fit_json(const datasets::Study& study, const calibration::OedometerFit& fit) {
  ordered_json json = fit_json(fit.result);
  json["quantity"] = "ln(axial effective stress)";
  json["tests"] = ordered_json::array();
  for (std::size_t i = 0; i < fit.result.tests.size(); ++i) {
    ordered_json test = test_json(fit.result.tests[i]);
    const datasets::OedometerTest& read = fit.experiments[i]->test();
    test["data"] = data_name(read.record.file, study.file);
    test["rows_dropped"] = ordered_json::array();
    for (const datasets::RowNote& note : read.record.notes) {
      test["rows_dropped"].push_back({{"line", note.line}, {"what", note.what}});
    }
    test["columns_not_read"] = read.record.unknown_columns;
    test["stages_deduced"] = read.record.stages_deduced;
    json["tests"].push_back(std::move(test));
  }
  json["assumptions"] = study.assumptions;
  return json;
}

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
    test["simulation"] = slump_json(read.setup, comparison.simulation);
    json["tests"].push_back(std::move(test));
  }
  json["rms_mould_gone_mm"] = json_number(1e3 * fit.rms_mould_gone);
  json["simulations"] = fit.simulations;
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
  return json;
}

ordered_json result_json(const RunInfo& run, const datasets::SlumpFile& test,
                         const mpm::SlumpResult& result) {
  ordered_json json = result_head(run, "ok", {});
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
  // only a point that went astray has a place
  const bool placed = failure.kind == Kind::left_grid || failure.kind == Kind::not_finite;
  json["r_mm"] = placed ? json_number(1e3 * failure.r) : ordered_json(nullptr);
  json["z_mm"] = placed ? json_number(1e3 * failure.z) : ordered_json(nullptr);
  return json;
}

}  // namespace isotach::reports
