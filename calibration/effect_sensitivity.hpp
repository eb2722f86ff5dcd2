// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What effects that a fit does not have would do to its predictions: for score tests.
#pragma once

#include <span>
#include <vector>

#include "calibration/fit_oedometer.hpp"

namespace isotach::calibration {

/// The problem that a fit with those effects solved, weighted by the noise that it estimated; the fit's
/// answer is fit.result.main.coordinates.
[[nodiscard]] Problem problem_of(const datasets::Study& study, const OedometerFit& fit,
                                 const std::vector<datasets::FreeEffect>& free_effects, int threads);

/// Predictions of each of the experiments, held-out ones too, with the effects `on`, and their derivatives by
/// the parameters `by` (SI), a column each; of an amplitude that is zero from the admissible side.
/// `locals` are those of a fit (OedometerFit::locals), of which the starts of tests are taken.
/// To compare with a fit's own Jacobian: Problem::weighted of those that are fitted.
[[nodiscard]] tl::expected<std::vector<experiments::Linearisation>, experiments::PredictionFailure>
linearise_by_effects(const OedometerExperiments& experiments, const model::Parameters<double>& parameters,
                     const std::vector<std::vector<double>>& locals, const effects::Values<double>& on,
                     std::span<const effects::ParameterRef> by, int threads);

}  // namespace isotach::calibration
