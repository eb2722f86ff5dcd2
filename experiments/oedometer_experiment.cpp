// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/oedometer_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "experiments/effects_prediction.hpp"
#include "experiments/oedometer_path.hpp"
#include "integrators/integrate.hpp"

namespace isotach::experiments {

namespace {

/// f with the form of the state that the parameters ask for.
template <class S, class F>
auto in_smallest_form(const model::Parameters<S>& parameters, F&& f) {
  return parameters.rotates() ? f.template operator()<model::Fabric::omega>()
                              : f.template operator()<model::Fabric::none>();
}

/// What a prediction takes: inputs, by scalar.
template <class S>
struct Inputs {
  model::Parameters<S> parameters;
  std::vector<S> start;  ///< K0 and OCR, as far as they move
  effects::Values<S> effects;
};

/// The inputs out of an experiment's: `local` holds those of the start, then the free parameters of effects.
template <class S>
tl::expected<Inputs<S>, PredictionFailure> inputs_of(const model::Parameters<S>& parameters,
                                                     std::span<const S> local,
                                                     const effects::Values<double>& effects,
                                                     const std::vector<effects::ParameterRef>& free) {
  const std::size_t own = local.size() - free.size();
  Inputs<S> inputs{parameters, {local.begin(), local.begin() + static_cast<std::ptrdiff_t>(own)}, {}};
  if (effects.empty()) return inputs;
  const auto values = effects.cast<S>().with(std::span(free), local.subspan(own));
  if (!values) return tl::unexpected(PredictionFailure{values.error().message()});
  inputs.effects = values->acting_on(effects::TestKind::oedometer);
  return inputs;
}

template <class S>
tl::expected<std::vector<S>, PredictionFailure> predict_with(const Inputs<S>& inputs,
                                                             const datasets::OedometerTest& test,
                                                             const OedometerProtocol& protocol) {
  const std::span<const S> start(inputs.start);
  if (!inputs.effects.empty()) {
    return predict_with_effects(inputs.parameters, inputs.effects, test, protocol, start);
  }
  const model::Law<S> law(inputs.parameters);
  return in_smallest_form(inputs.parameters, [&]<model::Fabric K>() {
    return detail::predict_values<S, K>(law, test, protocol, start);
  });
}

template <class Jet>
Linearisation linearisation_of(const std::vector<Jet>& jets, Eigen::Index columns) {
  Linearisation result;
  result.jacobian.resize(static_cast<Eigen::Index>(jets.size()), columns);
  result.values.reserve(jets.size());
  for (std::size_t i = 0; i < jets.size(); ++i) {
    result.values.push_back(jets[i].a);
    result.jacobian.row(static_cast<Eigen::Index>(i)) = jets[i].v.head(columns).transpose();
  }
  return result;
}

/// f(first, count) of blocks of at most eight columns, side by side.
template <class F>
tl::expected<Linearisation, PredictionFailure> in_blocks_of_eight(Eigen::Index columns, F&& f) {
  Linearisation result;
  for (Eigen::Index first = 0; first < columns; first += 8) {
    const Eigen::Index count = std::min<Eigen::Index>(8, columns - first);
    tl::expected<Linearisation, PredictionFailure> part = f(first, count);
    if (!part) return part;
    if (first == 0) result.jacobian.resize(part->jacobian.rows(), columns);
    result.jacobian.middleCols(first, count) = part->jacobian;
    result.values = std::move(part->values);
  }
  return result;
}

}  // namespace

/// Prediction with derivatives along up to `Width` directions.
template <int Width>
tl::expected<Linearisation, PredictionFailure> OedometerExperiment::linearise_with(
    const model::Parameters<double>& parameters, std::span<const double> local,
    const Eigen::MatrixXd& directions) const {
  using Jet = ceres::Jet<double, Width>;
  const Eigen::Index columns = directions.cols();
  const auto jet = [&](double value, std::size_t input) {
    Jet result(value);
    result.v.head(columns) = directions.row(static_cast<Eigen::Index>(input)).transpose();
    return result;
  };
  model::ParameterValues<Jet> values;
  values.lode = parameters.lode();
  for (std::size_t i = 0; i < model::kParameterCount; ++i) {
    values.values[i] = jet(parameters[static_cast<model::ParameterId>(i)], i);
  }
  std::vector<Jet> local_jets;
  for (std::size_t k = 0; k < local.size(); ++k) {
    local_jets.push_back(jet(local[k], model::kParameterCount + k));
  }
  const auto inputs = inputs_of<Jet>(*model::Parameters<Jet>::create(values), local_jets, effects_, free_);
  if (!inputs) return tl::unexpected(inputs.error());
  const auto jets = predict_with<Jet>(*inputs, test_, protocol_);
  if (!jets) return tl::unexpected(jets.error());
  return linearisation_of(*jets, columns);
}

namespace {

PathPoint path_point(const model::Law<double>& law, double time, std::size_t row,
                     const model::State<double>& state, double void_ratio_at_start,
                     const OedometerStart& start) {
  return {time,
          row,
          -state.stress[0],
          detail::axial_strain_of(state.void_ratio, void_ratio_at_start, start),
          state.void_ratio,
          state.stress[1] / state.stress[0],
          law.overconsolidation_ratio(state)};
}

/// What a test lacks that an effect needs; nothing where it has all.
std::optional<std::string> lacking_for(const effects::Effect& effect, const datasets::OedometerTest& test) {
  switch (effect.need) {
    case effects::Need::diameter:
      if (!test.diameter) return "diameter_mm";
      break;
    case effects::Need::temperature: {
      const auto read = [](const datasets::OedometerRow& row) { return row.temperature.has_value(); };
      if (std::none_of(test.record.rows.begin(), test.record.rows.end(), read)) {
        return "a column temperature_C in its data";
      }
      break;
    }
    case effects::Need::nothing:
      break;
  }
  return std::nullopt;
}

}  // namespace

OedometerExperiment::OedometerExperiment(datasets::OedometerTest test, effects::Values<double> effects,
                                         std::vector<effects::ParameterRef> free)
    : test_(std::move(test)),
      protocol_(make_protocol(test_)),
      effects_(std::move(effects)),
      free_(std::move(free)) {
  if (protocol_.values.empty()) {
    throw std::invalid_argument(test_.name +
                                ": no reading is left to be compared behind the one it starts from");
  }
  for (const ComparedValue& value : protocol_.values) {
    measured_.push_back(value.measured);
    noise_.push_back(value.noise);
  }
  for (const auto& one : effects_.chosen()) {
    if (const auto lacking = lacking_for(*one.effect, test_)) {
      throw std::invalid_argument(
          fmt::format("{}: the effect {} needs {}", test_.name, one.effect->name, *lacking));
    }
  }
  for (const effects::ParameterRef& parameter : free_) {
    if (!effects_.has(*parameter.effect)) {
      throw std::invalid_argument(fmt::format("{} is free, but that effect is off", parameter.name()));
    }
  }
}

std::string_view OedometerExperiment::quantity() const {
  const auto is_strain = [](const ComparedValue& value) { return value.kind == ValueKind::strain; };
  if (std::all_of(values().begin(), values().end(), is_strain)) return "axial strain (-)";
  if (std::none_of(values().begin(), values().end(), is_strain)) return "ln(axial effective stress)";
  return "ln(axial effective stress), axial strain (-) where stress was held";
}

std::vector<Channel> OedometerExperiment::channels() const {
  std::vector<Channel> channels;
  for (const ValueKind kind : {ValueKind::log_stress, ValueKind::strain}) {
    Channel channel;
    const bool is_stress = kind == ValueKind::log_stress;
    channel.quantity = is_stress ? "ln(axial effective stress)" : "axial strain (-)";
    channel.stated_level = is_stress ? test_.noise.stress_relative : test_.noise.strain;
    channel.stated_floor = is_stress ? test_.noise.stress_floor : 0.0;
    bool opens = true;
    for (std::size_t i = 0; i < values().size(); ++i) {
      opens = opens || values()[i].opens_chain;
      if (values()[i].kind != kind) continue;
      if (opens) channel.chains.push_back(channel.values.size());
      opens = false;
      channel.values.push_back(i);
    }
    if (channel.values.empty()) continue;
    const auto count = static_cast<Eigen::Index>(channel.values.size());
    channel.known_variance.resize(count);
    if (is_stress) channel.inverse_stress.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const ComparedValue& value = values()[channel.values[static_cast<std::size_t>(i)]];
      channel.known_variance[i] = value.known_variance;
      if (is_stress) channel.inverse_stress[i] = 1.0 / row_of(value).axial_stress;
    }
    channels.push_back(std::move(channel));
  }
  return channels;
}

std::vector<LocalQuantity> OedometerExperiment::locals() const {
  std::vector<LocalQuantity> result;
  if (test_.free_K0.moves) {
    result.push_back({"K0", test_.initial_K0, 0.15, 2.0, false, test_.free_K0.std_error});
  }
  if (test_.initial_ocr && test_.free_ocr.moves) {
    result.push_back({"OCR", *test_.initial_ocr, 0.05, 100.0, true, test_.free_ocr.std_error});
  }
  for (const effects::ParameterRef& parameter : free_) {
    result.push_back(local_quantity(parameter, effects_[parameter]));
  }
  return result;
}

tl::expected<effects::Values<double>, PredictionFailure> OedometerExperiment::effects_at(
    std::span<const double> local) const {
  auto values = effects_.with(std::span(free_), local.subspan(local.size() - free_.size()));
  if (!values) return tl::unexpected(PredictionFailure{values.error().message()});
  return *std::move(values);
}

tl::expected<Values, PredictionFailure> OedometerExperiment::predict(
    const model::Parameters<double>& parameters, std::span<const double> local) const {
  const auto inputs = inputs_of<double>(parameters, local, effects_, free_);
  if (!inputs) return tl::unexpected(inputs.error());
  return predict_with<double>(*inputs, test_, protocol_);
}

tl::expected<Linearisation, PredictionFailure> OedometerExperiment::linearise(
    const model::Parameters<double>& parameters, std::span<const double> local,
    const Eigen::MatrixXd& directions) const {
  if (directions.cols() <= 4) return linearise_with<4>(parameters, local, directions);
  if (directions.cols() <= 8) return linearise_with<8>(parameters, local, directions);
  return in_blocks_of_eight(directions.cols(), [&](Eigen::Index first, Eigen::Index count) {
    return linearise_with<8>(parameters, local, directions.middleCols(first, count));
  });
}

tl::expected<Linearisation, PredictionFailure> OedometerExperiment::linearise_wander(
    const model::Parameters<double>& parameters, std::span<const double> local, Slot slot,
    const Eigen::MatrixXd& functions) const {
  using Jet = ceres::Jet<double, 8>;
  const std::vector<Jet> constant(local.begin(), local.end());
  const auto inputs = inputs_of<Jet>(parameters.cast<Jet>(), constant, effects_, free_);
  if (!inputs) return tl::unexpected(inputs.error());
  using Result = tl::expected<Linearisation, PredictionFailure>;
  return in_blocks_of_eight(functions.cols(), [&](Eigen::Index first, Eigen::Index count) -> Result {
    std::vector<Jet> change(static_cast<std::size_t>(functions.rows()), Jet(0.0));
    for (std::size_t i = 0; i < change.size(); ++i) {
      change[i].v.head(count) = functions.row(static_cast<Eigen::Index>(i)).segment(first, count);
    }
    const Wander<Jet> wander{slot, change};
    const auto jets = predict_with_effects<Jet>(inputs->parameters, inputs->effects, test_, protocol_,
                                                inputs->start, &wander);
    if (!jets) return tl::unexpected(jets.error());
    return linearisation_of(*jets, count);
  });
}

tl::expected<std::vector<PathPoint>, PredictionFailure> OedometerExperiment::path(
    const model::Parameters<double>& parameters, std::span<const double> local, Route route) const {
  const auto inputs = inputs_of<double>(parameters, local, effects_, free_);
  if (!inputs) return tl::unexpected(inputs.error());
  if (!inputs->effects.empty()) {
    return path_with_effects(parameters, inputs->effects, test_, protocol_, inputs->start, route);
  }
  const model::Law<double> law(parameters);
  const auto start = detail::initial_state<double, model::Fabric::omega>(
      law, test_, protocol_.start, std::span<const double>(inputs->start));
  if (!start) return tl::unexpected(start.error());
  std::vector<PathPoint> points;
  const auto add = [&](double time, std::size_t row, const model::State<double>& state) {
    points.push_back(path_point(law, time, row, state, start->void_ratio, protocol_.start));
  };
  model::State<double> state = model::general(*start);
  add(protocol_.start.time, protocol_.start.row, state);
  if (route == Route::fellin_ostermann) {
    auto failure = detail::follow<model::Fabric::omega>(
        law, test_, protocol_, *start, [&](std::size_t step, double time, const auto& axial) {
          add(time, protocol_.steps[step].row, model::general(axial));
        });
    if (failure) return tl::unexpected(std::move(*failure));
    return points;
  }
  integrators::Options options;
  options.method = integrators::Method::cvode;
  double time = protocol_.start.time;
  for (std::size_t i = 0; i < protocol_.steps.size(); ++i) {
    const DriveStep& step = protocol_.steps[i];
    integrators::Increment<double> increment;
    increment.duration = step.duration;
    if (step.stress_controlled) {
      increment.stress_controlled[0] = true;
      increment.stress_rate[0] = (-state.stress[0] - step.amount) / step.duration;
    } else {
      increment.strain_rate[0] = -step.amount / step.duration;
    }
    const auto result = integrators::integrate(law, state, increment, options);
    if (!result) return tl::unexpected(detail::step_failure(test_, protocol_, i, time, result.error()));
    state = result->state;
    time += step.duration;
    add(time, step.row, state);
  }
  return points;
}

Values OedometerExperiment::values_of(const std::vector<PathPoint>& path) const {
  Values result;
  for (const ComparedValue& value : values()) {
    const PathPoint& point = path[value.step + 1];  // the first is the start
    if (value.kind == ValueKind::log_stress) {
      result.push_back(std::log(point.axial_stress));
    } else {
      const double origin = value.strain_origin == kNoRow ? 0.0 : path[value.strain_origin + 1].axial_strain;
      result.push_back(point.axial_strain - origin);
    }
  }
  return result;
}

}  // namespace isotach::experiments
