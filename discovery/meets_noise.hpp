// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Whether a fit meets its tests to within the noise that the study states, which may be autocorrelated.
#pragma once

#include "calibration/fit_oedometer.hpp"

namespace isotach::discovery {

/// sum of (serial_share rho^k)^2 over k = 1, 2, ...: of the correlations of a value with those behind it;
/// rho in [0, 1).
[[nodiscard]] double squared_correlations(double rho, double serial_share);

/// Independent values whose mean square scatters as that of `count` values with those correlations: count/(1
/// + 2 sum), for an autoregression count (1 - rho^2)/(1 + rho^2) (Bayley and Hammersley, Suppl. J. R. Stat.
/// Soc. 8 (1946) 184-197, eq. for the variance); at least 1.
[[nodiscard]] double effective_count(double count, double squared_correlations);

/// True where every fitted test's rms is at most calibration::kAdequate times the noise stated, and so is
/// every stage's, or noise alone would exceed that in more than one of a thousand stages. `noise`, of a fit
/// to the same tests, says how far neighbours share an error: stages are short, and a run of errors on one
/// side is no misfit where the apparatus makes such runs.
[[nodiscard]] bool meets_noise(const calibration::OedometerFit& fit, const calibration::NoiseFit& noise);

}  // namespace isotach::discovery
