// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The law led through an oedometer test's history, with any scalar: values with exact derivatives.
#pragma once

#include <fmt/format.h>

#include <numbers>
#include <span>

#include "experiments/experiment.hpp"
#include "experiments/oedometer_protocol.hpp"
#include "integrators/confined.hpp"
#include "integrators/steady_oedometric.hpp"

namespace isotach::experiments::detail {

/// Far below any reading's noise, and no smaller: every fit pays for it.
inline constexpr double kIntegrationTolerance = 3e-5;

template <class S, model::Fabric K>
using AxialState = model::State<S, model::kAxial, K>;

/// The failure of a step in the words of the test's times and lines.
[[nodiscard]] inline PredictionFailure step_failure(const datasets::OedometerTest& test,
                                                    const OedometerProtocol& protocol, std::size_t step,
                                                    double begin, const integrators::Failure& failure) {
  const DriveStep& drive = protocol.steps[step];
  const std::string line =
      drive.row == kNoRow ? "" : fmt::format(" (line {})", test.record.rows[drive.row].line);
  return {fmt::format("{}: between time {:.6g} s and {:.6g} s{}: {}", test.name, begin,
                      begin + drive.duration, line, failure.message())};
}

/// Nothing that an effect would make of the start.
struct StartAsRead {
  /// The specimen's axial stress (Pa) of K0 and the one read.
  template <class S>
  [[nodiscard]] double axial_stress(const S&, double read) const {
    return read;
  }
  /// Sets what the state has beyond stress and void ratio.
  template <class State>
  void prepare(State&) const {}
  /// p_B of the law (Pa) where that of the specimen is given.
  template <class S>
  [[nodiscard]] S law_pressure(const S& p_B) const {
    return p_B;
  }
};

/// The state that the law starts from. `local` holds K0 and OCR as far as they move, in that order.
/// `alteration` is what effects make of it, as StartAsRead.
template <class S, model::Fabric K, class Alteration = StartAsRead>
[[nodiscard]] tl::expected<AxialState<S, K>, PredictionFailure> initial_state(
    const model::Law<S>& law, const datasets::OedometerTest& test, const OedometerStart& start,
    std::span<const S> local, const Alteration& alteration = {}) {
  std::size_t next = 0;
  S K0(test.initial_K0);
  if (test.free_K0.moves) {
    K0 = local[next++];
  } else if (test.K0_rule == datasets::InitialK0::steady) {
    constexpr double kAnyRate = 1e-6;  // K0 does not depend on it
    const auto steady = integrators::steady_oedometric(law.parameters(), kAnyRate);
    if (!steady) return tl::unexpected(PredictionFailure{test.name + ": initial K0: " + steady.error()});
    K0 = steady->K0;
  }
  AxialState<S, K> state;
  const auto axial_stress = alteration.axial_stress(K0, start.axial_stress);
  state.stress[0] = S(-axial_stress);
  state.stress[1] = K0 * (-axial_stress * std::numbers::sqrt2);
  state.void_ratio = S(start.void_ratio);
  if constexpr (K == model::Fabric::omega) state.omega.setConstant(S(0.0));
  alteration.prepare(state);
  if (!law.in_domain(state)) {
    return tl::unexpected(PredictionFailure{
        fmt::format("{}: the start (axial stress {:.4g} kPa, K0 {:.4g}, void ratio {:.4g}) is outside of the "
                    "law's domain (p > 0, q < 3p, e > 0)",
                    test.name, 1e-3 * start.axial_stress, model::value_of(K0), start.void_ratio)});
  }
  if (test.initial_ocr) {
    const S ocr = test.free_ocr.moves ? local[next] : S(*test.initial_ocr);
    const S p_B = ocr * law.measures(state).equivalent_pressure;
    state.void_ratio = law.void_ratio_at(S(alteration.law_pressure(p_B)));
  }
  return state;
}

/// Engineering axial strain since the test's beginning of a void ratio.
template <class S>
[[nodiscard]] S axial_strain_of(const S& void_ratio, const S& void_ratio_at_start,
                                const OedometerStart& start) {
  return 1.0 - (1.0 + void_ratio) / (1.0 + void_ratio_at_start) * (1.0 - start.axial_strain);
}

/// Leads the law through the history; `visit(step, time, state)` sees the end of every step.
template <model::Fabric K, class S, class Visit>
[[nodiscard]] std::optional<PredictionFailure> follow(const model::Law<S>& law,
                                                      const datasets::OedometerTest& test,
                                                      const OedometerProtocol& protocol,
                                                      AxialState<S, K> state, Visit&& visit) {
  integrators::Tolerance tolerance;
  tolerance.relative = kIntegrationTolerance;
  double substep = 0.0;
  double time = protocol.start.time;
  bool was_controlled = false;
  for (std::size_t i = 0; i < protocol.steps.size(); ++i) {
    const DriveStep& step = protocol.steps[i];
    integrators::ConfinedIncrement<S> increment;
    increment.stress_controlled = step.stress_controlled;
    increment.duration = step.duration;
    increment.axial_rate = step.stress_controlled ? S((-state.stress[0] - step.amount) / step.duration)
                                                  : S(-step.amount / step.duration);
    if (step.stress_controlled != was_controlled) substep = 0.0;
    was_controlled = step.stress_controlled;
    const auto done = integrators::integrate_confined(law, state, increment, tolerance, substep);
    if (!done) return step_failure(test, protocol, i, time, done.error());
    time += step.duration;
    visit(i, time, state);
  }
  return std::nullopt;
}

/// What the instrument reads of a specimen without effects: the law's own stress and strain.
template <class S>
struct SoilReading {
  S stress;  ///< Pa, tension positive
  S void_ratio;
  const S* void_ratio_at_start;
  const OedometerStart* start;

  [[nodiscard]] S axial_stress() const { return -stress; }
  [[nodiscard]] S axial_strain() const { return axial_strain_of(void_ratio, *void_ratio_at_start, *start); }
};

/// The compared values, out of what is read at the end of every step: `follow(visit)` calls
/// `visit(step, reading)` for each and returns the failure, if there is one.
template <class S, class Reading, class Follow>
[[nodiscard]] tl::expected<std::vector<S>, PredictionFailure> compared_values(
    const OedometerProtocol& protocol, const Reading& at_start, Follow&& follow) {
  using std::log;
  std::vector<S> values;
  values.reserve(protocol.values.size());
  S origin(0.0);
  Reading last = at_start;
  auto failure = follow([&](std::size_t step, const Reading& reading) {
    if (values.size() == protocol.values.size()) return;
    const ComparedValue& value = protocol.values[values.size()];
    if (value.kind == ValueKind::log_stress) {
      if (value.step == step) values.push_back(log(reading.axial_stress()));
    } else {
      if (value.strain_origin == kNoRow) {
        origin = S(0.0);
      } else if (step == value.strain_origin + 1) {
        origin = last.axial_strain();
      }
      if (value.step == step) values.push_back(reading.axial_strain() - origin);
    }
    last = reading;
  });
  if (failure) return tl::unexpected(std::move(*failure));
  return values;
}

/// The compared values, with the scalar of the parameters.
template <class S, model::Fabric K>
[[nodiscard]] tl::expected<std::vector<S>, PredictionFailure> predict_values(
    const model::Law<S>& law, const datasets::OedometerTest& test, const OedometerProtocol& protocol,
    std::span<const S> local) {
  const auto start = initial_state<S, K>(law, test, protocol.start, local);
  if (!start) return tl::unexpected(start.error());
  const auto reading = [&](const auto& state) {
    return SoilReading<S>{state.stress[0], state.void_ratio, &start->void_ratio, &protocol.start};
  };
  return compared_values<S>(protocol, reading(*start), [&](auto&& visit) {
    return follow<K>(law, test, protocol, *start,
                     [&](std::size_t step, double, const auto& state) { visit(step, reading(state)); });
  });
}

}  // namespace isotach::experiments::detail
