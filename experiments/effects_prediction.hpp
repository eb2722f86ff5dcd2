// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Predictions of oedometer tests with effects: compiled once for each scalar.
#pragma once

#include <span>
#include <vector>

#include "effects/values.hpp"
#include "experiments/experiment.hpp"
#include "experiments/oedometer_protocol.hpp"
#include "experiments/path_point.hpp"
#include "experiments/wander.hpp"

namespace isotach::experiments {

/// The compared values, for S = double and the jets that OedometerExperiment uses. `effects` are those of
/// oedometer tests that act; `local` holds K0 and OCR of the start as far as they move; `wander` may be null.
template <class S>
[[nodiscard]] tl::expected<std::vector<S>, PredictionFailure> predict_with_effects(
    const model::Parameters<S>& parameters, const effects::Values<S>& effects,
    const datasets::OedometerTest& test, const OedometerProtocol& protocol, std::span<const S> local,
    const Wander<S>* wander = nullptr);

/// The start and the end of every step of the history.
[[nodiscard]] tl::expected<std::vector<PathPoint>, PredictionFailure> path_with_effects(
    const model::Parameters<double>& parameters, const effects::Values<double>& effects,
    const datasets::OedometerTest& test, const OedometerProtocol& protocol, std::span<const double> local,
    Route route);

}  // namespace isotach::experiments
