// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Profile likelihood of what an oedometer fit found.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "calibration/profile.hpp"

namespace isotach::calibration {

/// Profiles coordinate k of a fit about its answer. `problem` is the fit's own, by its noise; the interval is
/// that of `quantile` standard errors where the cost is quadratic. Where residuals keep a correlation the
/// misfit has to rise by more, as the fit's standard errors are larger.
[[nodiscard]] Profile profile_of(const OedometerFit& fit, const Problem& problem, std::size_t k,
                                 double quantile, const OptimiserControl& control);

}  // namespace isotach::calibration
