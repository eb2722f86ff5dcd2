// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How an oedometer fit depends on each test, on assumed inputs and on the integrator.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// The fit without each of its tests in turn: parameters, and how the test left out is predicted.
[[nodiscard]] Table left_out_table(const calibration::OedometerFit& fit);
/// Shift of each quantity in its unit and in standard errors with each input that was assumed.
[[nodiscard]] Table input_table(const calibration::OedometerFit& fit);
/// Largest difference of the two integrators' predictions.
[[nodiscard]] Table integrator_table(const calibration::OedometerFit& fit);

/// All of it; of a fit without assessment nothing.
void add_robustness(Page& page, const calibration::OedometerFit& fit);

}  // namespace isotach::reports
