// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The parts of result.json that all fits share.
#include "reports/fit_json.hpp"

#include "reports/estimates.hpp"
#include "reports/json_number.hpp"

namespace isotach::reports {

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
        {"verdict", calibration::name_of(estimate.verdict)},
        {"words", estimate.words}};
  }
  return json;
}

ordered_json shared_estimates_json(const std::vector<calibration::LocalEstimate>& estimates) {
  ordered_json json = ordered_json::object();
  for (const calibration::LocalEstimate& si : estimates) {
    if (!si.shared()) continue;
    const calibration::LocalEstimate estimate = in_key_unit(si);
    json[estimate.name] = {
        {"value", json_number(estimate.value)},
        {"unit", si.effect ? si.effect->info().unit : std::string_view("-")},
        {"std_error", json_number(estimate.std_error)},
        {"ci95", ordered_json::array({json_number(estimate.ci95_lower), json_number(estimate.ci95_upper)})},
        {"verdict", calibration::name_of(estimate.verdict)},
        {"words", estimate.words}};
  }
  return json;
}

ordered_json by_coordinate(const calibration::FitResult& result, std::span<const double> numbers) {
  ordered_json json = ordered_json::object();
  for (std::size_t k = 0; k < result.coordinates.size(); ++k) {
    json[coordinate_name(result.coordinates[k])] =
        k < numbers.size() ? json_number(numbers[k]) : ordered_json(nullptr);
  }
  return json;
}

namespace {

ordered_json correlation_json(const calibration::FitResult& result) {
  ordered_json json;
  json["names"] = coordinate_names(result);
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

}  // namespace

ordered_json quantities_json(const calibration::FitResult& result, std::span<const double> coordinates) {
  ordered_json json = ordered_json::object();
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    json[quantity_key(result.coordinates[k])] =
        json_number(quantity_at(result.coordinates[k], coordinates[k]));
  }
  return json;
}

ordered_json route_json(const calibration::FitResult& result, const calibration::OptimiserResult& route) {
  return {{"route", route.route},
          {"converged", route.converged},
          {"termination", route.termination},
          {"parameters", quantities_json(result, route.coordinates)},
          {"cost", json_number(route.cost)},
          {"evaluations", route.evaluations},
          {"failed_evaluations", route.failed_evaluations}};
}

ordered_json fit_json(const calibration::FitResult& result) {
  ordered_json json;
  json["parameters"] = parameters_json(result.estimates);
  json["parameters"].update(shared_estimates_json(result.local_estimates));
  json["adequate"] = result.adequate;
  json["gauge"] = gauge_json(result);
  json["null_directions"] = ordered_json::array();
  for (const Eigen::VectorXd& direction : result.uncertainty.null_directions) {
    json["null_directions"].push_back(
        by_coordinate(result, {direction.data(), static_cast<std::size_t>(direction.size())}));
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

}  // namespace isotach::reports
