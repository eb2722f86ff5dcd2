// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/oedometer_start.hpp"

#include <algorithm>
#include <cmath>

#include "integrators/steady_oedometric.hpp"

namespace isotach::calibration {

std::vector<CurvePoint> compression_curve_of(const experiments::OedometerExperiment& experiment) {
  const datasets::OedometerRecord& record = experiment.test().record;
  std::vector<CurvePoint> curve;
  const auto add = [&](const datasets::OedometerRow& row, double stress, datasets::Stage stage) {
    const double void_ratio = experiment.void_ratio_of(row);
    if (!(void_ratio > 0.0)) return;
    const std::size_t segment =
        curve.empty() ? 0 : curve.back().segment + (curve.back().stage == stage ? 0 : 1);
    curve.push_back({row.time, stress, void_ratio, stage, segment});
  };
  if (record.control == datasets::Control::strain) {
    for (const datasets::OedometerRow& row : record.rows) add(row, row.axial_stress, row.stage);
    return curve;
  }
  for (const datasets::LoadStep& step : record.steps) {
    for (std::size_t i = step.first; i < step.first + step.count; ++i) {
      add(record.rows[i], step.load, step.stage);
    }
  }
  return curve;
}

StartValues start_values_of(
    const std::vector<std::shared_ptr<const experiments::OedometerExperiment>>& experiments,
    const model::Parameters<double>& material, double reference_rate) {
  std::vector<std::vector<CurvePoint>> curves;
  for (const auto& experiment : experiments) {
    if (!experiment->held_out()) curves.push_back(compression_curve_of(*experiment));
  }
  constexpr double kUnitRate = 1.0;
  const auto steady = integrators::steady_oedometric(material, kUnitRate);
  const double K0 = steady ? steady->K0 : 1.0 - std::sin(material.phi_c());
  if (!(reference_rate > 0.0)) {
    reference_rate = steady ? material.D_r() / steady->viscous_rate : material.D_r();
  }
  return start_values(curves, material.phi_c(), K0, reference_rate);
}

std::vector<double> start_from(const StartValues& values, const Parametrisation& parametrisation) {
  using model::ParameterId;
  std::vector<double> x = parametrisation.start();
  const auto value_for = [&](ParameterId id) -> std::optional<double> {
    switch (id) {
      case ParameterId::e100:
        return values.e100.value;
      case ParameterId::lambda:
        return values.lambda.value;
      case ParameterId::kappa:
        return values.kappa.value;
      case ParameterId::I_v:
        return values.I_v.value;
      default:
        return std::nullopt;
    }
  };
  for (std::size_t k = 0; k < parametrisation.free().size(); ++k) {
    const Coordinate& coordinate = parametrisation.coordinates()[k];
    const auto value = value_for(*coordinate.id);
    if (!value || !(*value > 0.0)) continue;
    x[k] = std::clamp(std::log(*value), coordinate.lower, coordinate.upper);
  }
  return x;
}

}  // namespace isotach::calibration
