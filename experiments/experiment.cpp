// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/experiment.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::experiments {

namespace {

// Steps large against the noise of a simulation and small against the range of a parameter.
double difference_step(model::ParameterId id, double value) {
  constexpr double kRelative = 0.03;
  constexpr double kLeast = 0.02;  // of a parameter that may be zero
  return model::may_be_zero(id) ? std::max(kLeast, kRelative * value) : kRelative * value;
}

}  // namespace

tl::expected<Linearisation, PredictionFailure> Experiment::linearise(
    const model::Parameters<double>& parameters, std::span<const model::ParameterId> with_respect_to) const {
  auto centre = predict(parameters);
  if (!centre) return tl::unexpected(centre.error());
  Linearisation result{std::move(*centre), {}};
  const auto rows = static_cast<Eigen::Index>(result.values.size());
  result.jacobian.resize(rows, static_cast<Eigen::Index>(with_respect_to.size()));
  for (std::size_t k = 0; k < with_respect_to.size(); ++k) {
    const model::ParameterId id = with_respect_to[k];
    const double step = difference_step(id, parameters[id]);
    // one-sided where the other side is not admissible
    Values ends[2] = {result.values, result.values};
    double width = 0.0;
    for (const int side : {0, 1}) {
      model::ParameterValues<double> moved = parameters.values();
      moved[id] += side == 0 ? -step : step;
      const auto admissible = model::Parameters<double>::create(moved);
      if (!admissible) continue;
      auto values = predict(*admissible);
      if (!values) return tl::unexpected(values.error());
      ends[side] = std::move(*values);
      width += step;
    }
    for (Eigen::Index row = 0; row < rows; ++row) {
      const auto i = static_cast<std::size_t>(row);
      result.jacobian(row, static_cast<Eigen::Index>(k)) =
          width > 0.0 ? (ends[1][i] - ends[0][i]) / width : 0.0;
    }
  }
  return result;
}

Values Experiment::scaled_residuals(const Values& predicted) const {
  Values scaled(predicted.size());
  for (std::size_t i = 0; i < predicted.size(); ++i) scaled[i] = (predicted[i] - measured()[i]) / noise()[i];
  return scaled;
}

double root_mean_square(std::span<const double> values) {
  if (values.empty()) return 0.0;
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace isotach::experiments
