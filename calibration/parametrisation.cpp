// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/parametrisation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isotach::calibration {

datasets::Bounds default_bounds(model::ParameterId id) {
  using enum model::ParameterId;
  switch (id) {
    case e100:
      return {0.05, 15.0};
    case lambda:
      return {0.005, 1.0};
    case kappa:
      return {2e-4, 0.5};
    case I_v:
      return {0.004, 0.2};
    case D_r:
      return {1e-16, 1.0};
    case phi_c:
      return {3.0 * std::numbers::pi / 180.0, 50.0 * std::numbers::pi / 180.0};
    case C_1:
      return {0.0, 0.7};
    case C_2:
      return {0.0, 1000.0};
    case C_3:
      return {0.0, 0.95};
  }
  return {0.0, 0.0};
}

Parametrisation::Parametrisation(
    const model::Parameters<double>& start, const std::vector<model::ParameterId>& wanted,
    const std::array<std::optional<datasets::Bounds>, model::kParameterCount>& bounds,
    const GaugeChoice& gauge)
    : base_(start.values()), gauge_(gauge) {
  for (const model::ParameterId id : wanted) {
    if (id == model::ParameterId::D_r && gauge.kind != datasets::Gauge::none) {
      gauged_ = gauge.kind == datasets::Gauge::crs_rate;
      continue;
    }
    const datasets::Bounds range = bounds[static_cast<std::size_t>(id)].value_or(default_bounds(id));
    const double value = std::clamp(start[id], range.lower, range.upper);
    free_.push_back(id);
    const bool log = logarithmic(free_.size() - 1);
    start_.push_back(log ? std::log(value) : value);
    lower_.push_back(log ? std::log(range.lower) : range.lower);
    upper_.push_back(log ? std::log(range.upper) : range.upper);
  }
}

tl::expected<Parametrisation::Tangent, std::string> Parametrisation::tangent(
    const std::vector<double>& x) const {
  using Jet = ceres::Jet<double, static_cast<int>(model::kParameterCount)>;
  std::vector<Jet> jets;
  for (std::size_t k = 0; k < x.size(); ++k) jets.emplace_back(x[k], static_cast<int>(k));
  const auto parameters = at(jets);
  if (!parameters) return tl::unexpected(parameters.error());
  auto plain = at(x);
  if (!plain) return tl::unexpected(plain.error());
  const auto columns = static_cast<Eigen::Index>(x.size());
  Tangent result{*plain, Eigen::MatrixXd(static_cast<Eigen::Index>(model::kParameterCount), columns)};
  for (std::size_t i = 0; i < model::kParameterCount; ++i) {
    result.derivative.row(static_cast<Eigen::Index>(i)) =
        (*parameters)[static_cast<model::ParameterId>(i)].v.head(columns).transpose();
  }
  return result;
}

}  // namespace isotach::calibration
