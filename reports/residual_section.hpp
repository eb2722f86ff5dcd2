// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Residuals of an oedometer fit: against time and stress, by stage, their order, and the noise they show.
#pragma once

#include <span>

#include "reports/oedometer_view.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// Count, size, side and chance of the residuals of every stage of every test.
[[nodiscard]] Table stage_table(const calibration::OedometerFit& fit);
/// Runs and Ljung-Box tests before and after whitening.
[[nodiscard]] Table pattern_table(const calibration::OedometerFit& fit);
/// Noise stated and estimated, by channel.
[[nodiscard]] Table noise_table(const calibration::OedometerFit& fit);

void add_residuals(Page& page, const calibration::OedometerFit& fit, std::span<const TestView> views);

}  // namespace isotach::reports
