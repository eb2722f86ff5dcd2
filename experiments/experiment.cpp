// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isotach::experiments {

namespace {

// Steps large against the noise of a simulation and small against the range of a parameter.
constexpr double kRelativeStep = 0.03;

double difference_step(model::ParameterId id, double value) {
  constexpr double kLeast = 0.02;  // of a parameter that may be zero
  return model::may_be_zero(id) ? std::max(kLeast, kRelativeStep * value) : kRelativeStep * value;
}

double difference_step(const LocalQuantity& quantity, double value) {
  constexpr double kLeast = 0.2;  // of an effect's typical value
  const double step = kRelativeStep * std::abs(value);
  if (!quantity.effect || quantity.logarithmic) return step;
  return std::max(kLeast * quantity.effect->info().typical_si(), step);
}

}  // namespace

LocalQuantity local_quantity(const effects::ParameterRef& parameter, double value) {
  const effects::EffectParameter& info = parameter.info();
  return {parameter.name(), value,        info.lower_si(), info.upper_si(),
          info.lower > 0.0, std::nullopt, parameter};
}

std::vector<Channel> Experiment::channels() const {
  Channel channel;
  channel.quantity = quantity();
  channel.values.resize(measured().size());
  std::iota(channel.values.begin(), channel.values.end(), std::size_t{0});
  channel.chains = {0};
  if (!noise().empty()) channel.stated_level = noise().front();
  channel.known_variance = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(measured().size()));
  return {std::move(channel)};
}

std::vector<double> Experiment::local_values() const {
  std::vector<double> values;
  for (const LocalQuantity& local : locals()) values.push_back(local.value);
  return values;
}

tl::expected<Linearisation, PredictionFailure> Experiment::linearise(
    const model::Parameters<double>& parameters, std::span<const double> local,
    const Eigen::MatrixXd& directions) const {
  auto centre = predict(parameters, local);
  if (!centre) return tl::unexpected(centre.error());
  Linearisation result{std::move(*centre), {}};
  const auto rows = static_cast<Eigen::Index>(result.values.size());
  result.jacobian = Eigen::MatrixXd::Zero(rows, directions.cols());
  const std::vector<LocalQuantity> quantities = locals();
  for (std::size_t k = 0; k < model::kParameterCount + local.size(); ++k) {
    const auto input = static_cast<Eigen::Index>(k);
    if (directions.row(input).isZero(0.0)) continue;
    const bool material = k < model::kParameterCount;
    const auto id = static_cast<model::ParameterId>(k);
    const double step =
        material ? difference_step(id, parameters[id])
                 : difference_step(quantities[k - model::kParameterCount], local[k - model::kParameterCount]);
    // one-sided where the other side is not admissible or fails
    Values ends[2] = {result.values, result.values};
    double width = 0.0;
    std::optional<PredictionFailure> failure;
    for (const int side : {0, 1}) {
      model::ParameterValues<double> moved = parameters.values();
      std::vector<double> moved_local(local.begin(), local.end());
      (material ? moved[id] : moved_local[k - model::kParameterCount]) += side == 0 ? -step : step;
      const auto admissible = model::Parameters<double>::create(moved);
      if (!admissible) continue;
      auto values = predict(*admissible, moved_local);
      if (!values) {
        failure = values.error();
        if (failure->interrupted) return tl::unexpected(*failure);
        continue;
      }
      ends[side] = std::move(*values);
      width += step;
    }
    if (!(width > 0.0)) {
      if (failure) return tl::unexpected(*failure);
      continue;
    }
    for (Eigen::Index row = 0; row < rows; ++row) {
      const auto i = static_cast<std::size_t>(row);
      result.jacobian.row(row) += (ends[1][i] - ends[0][i]) / width * directions.row(input);
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
