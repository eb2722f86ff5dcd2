// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How well an oedometer fit's data determine each quantity: profiles, intervals, correlation, null direction.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// The least misfit while one coordinate is held elsewhere, with the threshold of the 95 % interval and the
/// parabola of the standard error.
[[nodiscard]] Figure profile_figure(const calibration::FitResult& result,
                                    const calibration::Profile& profile);
/// Intervals of every fitted quantity by standard error, profile and, where there is one, bootstrap.
[[nodiscard]] Table interval_table(const calibration::OedometerFit& fit);

/// Says on what standard errors rest; profiles, intervals, correlation, gauge and null directions.
void add_uncertainty(Page& page, const calibration::OedometerFit& fit);

}  // namespace isotach::reports
