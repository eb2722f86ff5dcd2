// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/slump_experiment.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/slump_effects.hpp"
#include "experiments/outline_distance.hpp"

namespace isotach::experiments {

namespace {

constexpr double kSpacing = 4e-3;  // m of outline for each station: some twenty on a slump of this size

/// OCR0 moves as its logarithm.
LocalQuantity local_quantity(const datasets::FreeMud& mud, const mpm::Mud& stated) {
  const bool ocr = mud.quantity == datasets::MudQuantity::overconsolidation_ratio;
  const double value = datasets::stated_value(stated, mud.quantity).value();
  // an OCR0 below 1 flows faster than at D_r as it is released; by a fifth of 1 + e0 strength changes as much
  // as from soup to stiff clay
  const datasets::Bounds wide =
      ocr ? datasets::Bounds{std::min(0.8, value), std::max(10.0, value)}
          : datasets::Bounds{std::max(0.1 * value, value - 0.2 * (1.0 + value)), value + 0.2 * (1.0 + value)};
  const datasets::Bounds bounds = mud.bounds.value_or(wide);
  LocalQuantity quantity{std::string(name_of(mud.quantity)), value, bounds.lower, bounds.upper, ocr, {}};
  if (mud.std_error) quantity.std_error = ocr ? *mud.std_error / value : *mud.std_error;
  quantity.of_all = true;
  return quantity;
}

}  // namespace

OutlineErrors errors_of(const datasets::SlumpNoise& noise, const SharedError& simulation) {
  const double reading2 = std::max(0.0, noise.outline * noise.outline - noise.shared * noise.shared);
  OutlineErrors errors;
  errors.reading = std::sqrt(reading2);
  errors.measuring.outline = noise.shared;
  errors.measuring.lifting = std::sqrt(std::max(0.0, noise.lifting * noise.lifting - reading2));
  errors.simulation = simulation;
  return errors;
}

SlumpExperiment::SlumpExperiment(datasets::SlumpTest test, SlumpModel model)
    : test_(std::move(test)), model_(std::move(model)) {
  for (std::size_t k = 0; k < test_.outlines.size(); ++k) {
    const datasets::Outline& outline = test_.outlines[k];
    double top = 0.0;
    for (const auto& point : outline.points) top = std::max(top, point.z);
    const bool gone = test_.setup.mould.rim(outline.time) >= top;
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
      point_noise_.push_back(gone ? test_.noise.outline : test_.noise.lifting);
      mould_gone_.push_back(gone);
      outline_index_.push_back(k);
    }
  }
  stations_ = outline_stations(test_.outlines, kSpacing);
  std::vector<bool> gone;
  for (const OutlineStation& station : stations_) gone.push_back(mould_gone_[station.points.front()]);
  factor_.compute(station_covariance(stations_, gone, errors_of(test_.noise, model_.simulation_error)));
  zeros_.assign(stations_.size(), 0.0);
  ones_.assign(stations_.size(), 1.0);
}

std::vector<LocalQuantity> SlumpExperiment::locals() const {
  std::vector<LocalQuantity> quantities;
  for (const datasets::FreeMud& mud : model_.mud) quantities.push_back(local_quantity(mud, test_.setup.mud));
  for (const effects::ParameterRef& parameter : model_.free) {
    quantities.push_back(local_quantity(parameter, model_.effects[parameter]));
  }
  return quantities;
}

double SlumpExperiment::cost() const {
  return test_.setup.mould.fill_height * test_.setup.mould.diameter * test_.setup.times.back();
}

tl::expected<effects::Values<double>, PredictionFailure> SlumpExperiment::effects_at(
    std::span<const double> local) const {
  auto values = model_.effects.with(std::span<const effects::ParameterRef>(model_.free),
                                    local.subspan(model_.mud.size()));
  if (!values) return tl::unexpected(PredictionFailure{values.error().message()});
  return *std::move(values);
}

mpm::Mud SlumpExperiment::mud_at(std::span<const double> local) const {
  return datasets::with_values(test_.setup.mud, model_.mud, local.first(model_.mud.size()));
}

tl::expected<mpm::SlumpResult, PredictionFailure> SlumpExperiment::simulate(
    mpm::SlumpSetup setup, const model::Parameters<double>& parameters, std::span<const double> local) const {
  const auto effects = effects_at(local);
  if (!effects) return tl::unexpected(effects.error());
  setup = datasets::with_effects(std::move(setup), *effects);
  setup.mud = mud_at(local);
  auto result = model_.simulate(test_.name, parameters, setup);
  if (!result) {
    return tl::unexpected(PredictionFailure{test_.name + ": " + result.error().message,
                                            result.error().status == mpm::RunStatus::interrupted});
  }
  return std::move(*result);
}

tl::expected<mpm::SlumpResult, PredictionFailure> SlumpExperiment::simulate(
    const model::Parameters<double>& parameters, std::span<const double> local) const {
  return simulate(test_.setup, parameters, local);
}

tl::expected<mpm::SlumpResult, PredictionFailure> SlumpExperiment::simulate_at_best(
    const model::Parameters<double>& parameters, std::span<const double> local) const {
  return simulate(test_.best_setup(), parameters, local);
}

Values SlumpExperiment::distances(const mpm::SlumpResult& result) const {
  Values values;
  values.reserve(point_noise_.size());
  for (std::size_t k = 0; k < test_.outlines.size(); ++k) {
    for (const auto& point : test_.outlines[k].points) {
      values.push_back(signed_distance({point.r, point.z}, result.outlines[k].points));
    }
  }
  return values;
}

Values SlumpExperiment::in_noise(const Values& distances) const {
  Values scaled;
  scaled.reserve(distances.size());
  for (std::size_t i = 0; i < distances.size(); ++i) scaled.push_back(distances[i] / point_noise_[i]);
  return scaled;
}

Values SlumpExperiment::decorrelated(const Values& distances) const {
  Values means = station_means(stations_, distances);
  factor_.matrixL().solveInPlace(
      Eigen::Map<Eigen::VectorXd>(means.data(), static_cast<Eigen::Index>(means.size())));
  return means;
}

Values SlumpExperiment::seen(const mpm::SlumpResult& result) const {
  Values corrected = distances(result);
  for (std::size_t i = 0; i < model_.correction.size(); ++i) corrected[i] += model_.correction[i];
  return decorrelated(corrected);
}

tl::expected<Values, PredictionFailure> SlumpExperiment::predict(const model::Parameters<double>& parameters,
                                                                 std::span<const double> local) const {
  const auto result = simulate(parameters, local);
  if (!result) return tl::unexpected(result.error());
  return seen(*result);
}

tl::expected<Values, PredictionFailure> SlumpExperiment::predict_wandering(
    const mpm::Wander& wander, const model::Parameters<double>& parameters,
    std::span<const double> local) const {
  mpm::SlumpSetup setup = test_.setup;
  setup.wander = wander;
  const auto result = simulate(std::move(setup), parameters, local);
  if (!result) return tl::unexpected(result.error());
  return seen(*result);
}

}  // namespace isotach::experiments
