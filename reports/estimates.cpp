// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Units, coordinates and gauge of fitted parameters.
#include "reports/estimates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/number.hpp"

namespace isotach::reports {

double in_key_unit(model::ParameterId id, double si) {
  return si / model::info(id).to_si;
}

calibration::ParameterEstimate in_key_unit(const calibration::ParameterEstimate& estimate) {
  calibration::ParameterEstimate result = estimate;
  for (double* number : {&result.value, &result.std_error, &result.ci95_lower, &result.ci95_upper}) {
    *number = in_key_unit(estimate.id, *number);
  }
  return result;
}

calibration::LocalEstimate in_key_unit(const calibration::LocalEstimate& estimate) {
  calibration::LocalEstimate result = estimate;
  if (!estimate.effect) return result;
  for (double* number : {&result.value, &result.std_error, &result.ci95_lower, &result.ci95_upper}) {
    *number /= estimate.effect->info().to_si;
  }
  return result;
}

double quantity_at(const calibration::Coordinate& coordinate, double x) {
  const double si = coordinate.quantity(x);
  if (coordinate.effect) return si / coordinate.effect->info().to_si;
  return coordinate.id ? in_key_unit(*coordinate.id, si) : si;
}

std::string coordinate_name(const calibration::Coordinate& coordinate) {
  return (coordinate.logarithmic ? "ln " : "") + coordinate.name;
}

std::string quantity_name(const calibration::Coordinate& coordinate) {
  if (!coordinate.id || model::info(*coordinate.id).unit == "-") return coordinate.name;
  return fmt::format("{} ({})", coordinate.name, model::info(*coordinate.id).unit);
}

std::string quantity_key(const calibration::Coordinate& coordinate) {
  return coordinate.id ? std::string(model::info(*coordinate.id).key) : coordinate.name;
}

std::vector<std::string> coordinate_names(const calibration::FitResult& result) {
  std::vector<std::string> names;
  for (const calibration::Coordinate& coordinate : result.coordinates) {
    names.push_back(coordinate_name(coordinate));
  }
  return names;
}

bool is_free(const calibration::FitResult& result, model::ParameterId id) {
  return std::find(result.free.begin(), result.free.end(), id) != result.free.end();
}

const calibration::ParameterEstimate& estimate_of(const calibration::FitResult& result,
                                                  model::ParameterId id) {
  return result.estimates.at(static_cast<std::size_t>(id));
}

std::vector<calibration::ParameterEstimate> combined_estimates(const calibration::Calibration& calibration) {
  std::vector<calibration::ParameterEstimate> estimates;
  for (const model::ParameterInfo& parameter : model::kParameterTable) {
    if (calibration.I_v_is_joint && parameter.id == model::ParameterId::I_v) {
      estimates.push_back(estimate_of(calibration.joint->result, parameter.id));
      continue;
    }
    const bool by_slump = is_free(calibration.slump.result, parameter.id);
    estimates.push_back(
        estimate_of(by_slump ? calibration.slump.result : calibration.oedometer.result, parameter.id));
  }
  return estimates;
}

std::string gauge_name(datasets::Gauge gauge) {
  switch (gauge) {
    case datasets::Gauge::crs_rate:
      return "crs-rate";
    case datasets::Gauge::fixed:
      return "fixed";
    case datasets::Gauge::none:
      return "none";
  }
  return {};
}

std::string gauge_sentence(const calibration::FitResult& result) {
  if (result.gauged) {
    return fmt::format(
        "D_r is set by the gauge: it is the viscous strain rate |D_vis| of steady oedometric compression at "
        "an "
        "axial strain rate of {} 1/s, so OCR = 1 on that isotach and e100 is read off it.",
        format_number(result.gauge.reference_rate, 3));
  }
  const bool e100_moves = is_free(result, model::ParameterId::e100);
  if (is_free(result, model::ParameterId::D_r)) {
    return e100_moves
               ? "No gauge was set, so e100 and D_r are not two numbers: they trade for each other along "
                 "a null direction without any change of a prediction."
               : "e100 is held at its given value, which is what makes D_r a number of its own.";
  }
  if (e100_moves) {
    return "D_r is held at its given value, which is what makes e100 a number of its own: OCR = 1 on the "
           "isotach whose viscous strain rate is D_r.";
  }
  return "e100 and D_r are both held at their given values, so no gauge is needed.";
}

}  // namespace isotach::reports
