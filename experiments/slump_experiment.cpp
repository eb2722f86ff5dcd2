// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/slump_experiment.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/slump_effects.hpp"
#include "experiments/outline_distance.hpp"

namespace isotach::experiments {

namespace {

constexpr double kSpacing = 4e-3;  // m of outline for each station: some twenty on a slump of this size

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

SlumpExperiment::SlumpExperiment(datasets::SlumpTest test, Simulate simulate,
                                 const SharedError& simulation_error, effects::Values<double> effects,
                                 std::vector<effects::ParameterRef> free)
    : test_(std::move(test)),
      simulate_(std::move(simulate)),
      effects_(std::move(effects)),
      free_(std::move(free)) {
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
  factor_.compute(station_covariance(stations_, gone, errors_of(test_.noise, simulation_error)));
  zeros_.assign(stations_.size(), 0.0);
  ones_.assign(stations_.size(), 1.0);
}

std::vector<LocalQuantity> SlumpExperiment::locals() const {
  std::vector<LocalQuantity> quantities;
  for (const effects::ParameterRef& parameter : free_) {
    quantities.push_back(local_quantity(parameter, effects_[parameter]));
  }
  return quantities;
}

double SlumpExperiment::cost() const {
  return test_.setup.mould.fill_height * test_.setup.mould.diameter * test_.setup.times.back();
}

tl::expected<effects::Values<double>, PredictionFailure> SlumpExperiment::effects_at(
    std::span<const double> local) const {
  auto values = effects_.with(std::span<const effects::ParameterRef>(free_), local);
  if (!values) return tl::unexpected(PredictionFailure{values.error().message()});
  return *std::move(values);
}

tl::expected<mpm::SlumpResult, PredictionFailure> SlumpExperiment::simulate(
    const model::Parameters<double>& parameters, std::span<const double> local) const {
  const auto effects = effects_at(local);
  if (!effects) return tl::unexpected(effects.error());
  auto result = simulate_(test_.name, parameters, datasets::with_effects(test_.setup, *effects));
  if (!result) {
    return tl::unexpected(PredictionFailure{test_.name + ": " + result.error().message,
                                            result.error().status == mpm::RunStatus::interrupted});
  }
  return std::move(*result);
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

tl::expected<Values, PredictionFailure> SlumpExperiment::predict(const model::Parameters<double>& parameters,
                                                                 std::span<const double> local) const {
  const auto result = simulate(parameters, local);
  if (!result) return tl::unexpected(result.error());
  return decorrelated(distances(*result));
}

}  // namespace isotach::experiments
