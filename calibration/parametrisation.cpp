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

namespace {

CoordinatePrior prior_of(const datasets::Prior& prior, bool logarithmic) {
  if (!logarithmic) return {prior.mean, prior.std_error};
  return {std::log(prior.mean), prior.std_error / prior.mean};
}

/// The coordinate of a local quantity within bounds of the quantity.
Coordinate coordinate_of(const experiments::LocalQuantity& local, std::string name,
                         const datasets::Bounds& bounds) {
  Coordinate coordinate;
  coordinate.name = std::move(name);
  coordinate.logarithmic = local.logarithmic;
  if (local.effect && !local.logarithmic) coordinate.scale = local.effect->info().typical_si();
  coordinate.start = coordinate.of_quantity(std::clamp(local.value, bounds.lower, bounds.upper));
  coordinate.lower = coordinate.of_quantity(bounds.lower);
  coordinate.upper = coordinate.of_quantity(bounds.upper);
  if (local.std_error) {
    coordinate.prior = CoordinatePrior{coordinate.of_quantity(local.value), *local.std_error};
  }
  return coordinate;
}

/// Of an effect's parameter those of the study, else the quantity's own.
datasets::Bounds bounds_of(const CoordinateSettings& settings, const experiments::LocalQuantity& local) {
  for (const datasets::FreeEffect& free : settings.effects) {
    if (free.parameter == local.effect && free.bounds) return *free.bounds;
  }
  return {local.lower, local.upper};
}

}  // namespace

Parametrisation::Parametrisation(const model::Parameters<double>& start,
                                 const std::vector<model::ParameterId>& wanted,
                                 const CoordinateSettings& settings, const GaugeChoice& gauge,
                                 const Experiments& experiments)
    : base_(start.values()), gauge_(gauge) {
  for (const model::ParameterId id : wanted) {
    if (id == model::ParameterId::D_r && gauge.kind != datasets::Gauge::none) {
      gauged_ = gauge.kind == datasets::Gauge::crs_rate;
      continue;
    }
    const auto index = static_cast<std::size_t>(id);
    const datasets::Bounds range = settings.bounds[index].value_or(default_bounds(id));
    const double value = std::clamp(start[id], range.lower, range.upper);
    const bool log = !model::may_be_zero(id);
    Coordinate coordinate;
    coordinate.name = model::info(id).name;
    coordinate.id = id;
    coordinate.logarithmic = log;
    coordinate.start = log ? std::log(value) : value;
    coordinate.lower = log ? std::log(range.lower) : range.lower;
    coordinate.upper = log ? std::log(range.upper) : range.upper;
    if (settings.priors[index]) coordinate.prior = prior_of(*settings.priors[index], log);
    free_.push_back(id);
    coordinates_.push_back(std::move(coordinate));
  }
  for (const auto& experiment : experiments) locals_.push_back(experiment->locals());
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (experiments[i]->held_out()) continue;
    for (const experiments::LocalQuantity& local : locals_[i]) {
      if (!local.shared() || find(local)) continue;
      Coordinate coordinate = coordinate_of(local, local.name, bounds_of(settings, local));
      coordinate.effect = local.effect;
      coordinate.shared = true;
      coordinates_.push_back(std::move(coordinate));
    }
  }
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (experiments[i]->held_out()) continue;
    for (std::size_t k = 0; k < locals_[i].size(); ++k) {
      const experiments::LocalQuantity& local = locals_[i][k];
      if (local.shared()) continue;
      Coordinate coordinate =
          coordinate_of(local, experiments[i]->name() + ": " + local.name, {local.lower, local.upper});
      coordinate.experiment = i;
      coordinate.local = k;
      coordinates_.push_back(std::move(coordinate));
    }
  }
}

std::optional<std::size_t> Parametrisation::find(const experiments::LocalQuantity& shared) const {
  for (std::size_t k = free_.size(); k < coordinates_.size(); ++k) {
    if (coordinates_[k].shared && coordinates_[k].name == shared.name) return k;
  }
  return std::nullopt;
}

double Coordinate::search_width(double x) const {
  constexpr double kTimes = 6.0;
  if (!effect || logarithmic) return upper - lower;
  return std::min(upper - lower, kTimes * std::max(1.0, std::abs(x)));
}

namespace {

template <class F>
std::vector<double> of_each(const std::vector<Coordinate>& coordinates, F&& f) {
  std::vector<double> values;
  for (const Coordinate& coordinate : coordinates) values.push_back(f(coordinate));
  return values;
}

}  // namespace

std::vector<double> Parametrisation::start() const {
  return of_each(coordinates_, [](const Coordinate& c) { return c.start; });
}

std::vector<double> Parametrisation::lower() const {
  return of_each(coordinates_, [](const Coordinate& c) { return c.lower; });
}

std::vector<double> Parametrisation::upper() const {
  return of_each(coordinates_, [](const Coordinate& c) { return c.upper; });
}

bool Parametrisation::at_bound(const std::vector<double>& x, std::size_t k) const {
  constexpr double kAtBound = 1e-7;
  return x[k] - coordinates_[k].lower < kAtBound || coordinates_[k].upper - x[k] < kAtBound;
}

std::vector<double> Parametrisation::inside(std::vector<double> x) const {
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] = std::clamp(x[k], coordinates_[k].lower, coordinates_[k].upper);
  }
  return x;
}

std::vector<double> Parametrisation::local_at(const std::vector<double>& x, std::size_t experiment) const {
  if (experiment >= locals_.size()) return {};
  std::vector<double> values;
  for (const experiments::LocalQuantity& local : locals_[experiment]) values.push_back(local.value);
  for (std::size_t k = free_.size(); k < coordinates_.size(); ++k) {
    if (!coordinates_[k].shared && coordinates_[k].experiment == experiment) {
      values[coordinates_[k].local] = coordinates_[k].quantity(x[k]);
    }
  }
  set_shared(locals_[experiment], x, values);
  return values;
}

std::vector<double> Parametrisation::local_of(const experiments::Experiment& experiment,
                                              const std::vector<double>& x) const {
  std::vector<double> values = experiment.local_values();
  set_shared(experiment.locals(), x, values);
  return values;
}

void Parametrisation::set_shared(const std::vector<experiments::LocalQuantity>& locals,
                                 const std::vector<double>& x, std::vector<double>& values) const {
  for (std::size_t i = 0; i < locals.size(); ++i) {
    const auto k = locals[i].shared() ? find(locals[i]) : std::nullopt;
    if (k) values[i] = coordinates_[*k].quantity(x[*k]);
  }
}

tl::expected<Parametrisation::Tangent, std::string> Parametrisation::tangent(
    const std::vector<double>& x) const {
  using Jet = ceres::Jet<double, static_cast<int>(model::kParameterCount)>;
  std::vector<Jet> jets;
  for (std::size_t k = 0; k < free_.size(); ++k) jets.emplace_back(x[k], static_cast<int>(k));
  const auto parameters = at(jets);
  if (!parameters) return tl::unexpected(parameters.error());
  auto plain = at(x);
  if (!plain) return tl::unexpected(plain.error());
  Tangent result{*plain, Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model::kParameterCount),
                                               static_cast<Eigen::Index>(x.size()))};
  const auto columns = static_cast<Eigen::Index>(free_.size());
  for (std::size_t i = 0; i < model::kParameterCount; ++i) {
    result.derivative.row(static_cast<Eigen::Index>(i)).head(columns) =
        (*parameters)[static_cast<model::ParameterId>(i)].v.head(columns).transpose();
  }
  return result;
}

Eigen::MatrixXd Parametrisation::directions(const Tangent& tangent, const std::vector<double>& x,
                                            std::size_t experiment) const {
  const std::size_t locals = experiment < locals_.size() ? locals_[experiment].size() : 0;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model::kParameterCount + locals),
                                                 static_cast<Eigen::Index>(size()));
  result.topRows(static_cast<Eigen::Index>(model::kParameterCount)) = tangent.derivative;
  for (std::size_t k = free_.size(); k < coordinates_.size(); ++k) {
    const Coordinate& coordinate = coordinates_[k];
    for (std::size_t i = 0; i < locals; ++i) {
      const experiments::LocalQuantity& local = locals_[experiment][i];
      const bool same =
          local.shared() ? coordinate.shared && coordinate.name == local.name
                         : !coordinate.shared && coordinate.experiment == experiment && coordinate.local == i;
      if (!same) continue;
      result(static_cast<Eigen::Index>(model::kParameterCount + i), static_cast<Eigen::Index>(k)) =
          coordinate.slope(x[k]);
    }
  }
  return result;
}

}  // namespace isotach::calibration
