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

/// The state that the law starts from. `local` holds K0 and OCR as far as they move, in that order.
template <class S, model::Fabric K>
[[nodiscard]] tl::expected<AxialState<S, K>, PredictionFailure> initial_state(
    const model::Law<S>& law, const datasets::OedometerTest& test, const OedometerStart& start,
    std::span<const S> local) {
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
  state.stress[0] = S(-start.axial_stress);
  state.stress[1] = K0 * (-start.axial_stress * std::numbers::sqrt2);
  state.void_ratio = S(start.void_ratio);
  if constexpr (K == model::Fabric::omega) state.omega.setConstant(S(0.0));
  if (!law.in_domain(state)) {
    return tl::unexpected(PredictionFailure{
        fmt::format("{}: the start (axial stress {:.4g} kPa, K0 {:.4g}, void ratio {:.4g}) is outside of the "
                    "law's domain (p > 0, q < 3p, e > 0)",
                    test.name, 1e-3 * start.axial_stress, model::value_of(K0), start.void_ratio)});
  }
  if (test.initial_ocr) {
    const S ocr = test.free_ocr.moves ? local[next] : S(*test.initial_ocr);
    state.void_ratio = law.void_ratio_at(S(ocr * law.measures(state).equivalent_pressure));
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

/// The compared values, with the scalar of the parameters.
template <class S, model::Fabric K>
[[nodiscard]] tl::expected<std::vector<S>, PredictionFailure> predict_values(
    const model::Law<S>& law, const datasets::OedometerTest& test, const OedometerProtocol& protocol,
    std::span<const S> local) {
  using std::log;
  const auto start = initial_state<S, K>(law, test, protocol.start, local);
  if (!start) return tl::unexpected(start.error());
  std::vector<S> values;
  values.reserve(protocol.values.size());
  S origin(0.0);
  S last_void_ratio = start->void_ratio;
  auto failure = follow<K>(law, test, protocol, *start, [&](std::size_t step, double, const auto& state) {
    if (values.size() == protocol.values.size()) return;
    const ComparedValue& value = protocol.values[values.size()];
    const auto strain = [&](const S& void_ratio) {
      return axial_strain_of(void_ratio, start->void_ratio, protocol.start);
    };
    if (value.kind == ValueKind::log_stress) {
      if (value.step == step) values.push_back(log(-state.stress[0]));
    } else {
      if (value.strain_origin == kNoRow) {
        origin = S(0.0);
      } else if (step == value.strain_origin + 1) {
        origin = strain(last_void_ratio);
      }
      if (value.step == step) values.push_back(strain(state.void_ratio) - origin);
    }
    last_void_ratio = state.void_ratio;
  });
  if (failure) return tl::unexpected(std::move(*failure));
  return values;
}

}  // namespace isotach::experiments::detail
