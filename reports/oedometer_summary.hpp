// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The first page of an oedometer fit: whether the model is adequate and where not, and the facts to sign by.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calibration/fit_oedometer.hpp"
#include "reports/oedometer_view.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// Whether the model is adequate; where it is not, which stages of which fitted tests are missed, by how many
/// times their noise, and whether the model lies above or below.
[[nodiscard]] std::string adequacy_sentence(const calibration::OedometerFit& fit);
/// How well held-out tests are predicted; empty where none is held out.
[[nodiscard]] std::string prediction_sentence(const calibration::OedometerFit& fit);
/// Whether residuals keep a pattern once the estimated noise is taken out of them; empty where they do not.
[[nodiscard]] std::string pattern_sentence(const calibration::OedometerFit& fit);

/// Verdicts on the model, the null direction, and the fit's warnings.
void add_oedometer_verdicts(Page& page, const calibration::OedometerFit& fit);

/// Data, gauge, noise, number of answers, agreement of routes and integrators.
void add_oedometer_facts(Page& page, const calibration::OedometerFit& fit);

/// The effects that the model has, at the answer; without rows where it has none.
[[nodiscard]] Table effect_table(const effects::Values<double>& effects);
/// Parameters of effects and quantities of tests' starts that were fitted; without rows where none was.
[[nodiscard]] Table start_estimate_table(const calibration::FitResult& result);

}  // namespace isotach::reports
