// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Quantiles and tail probabilities of the distributions that intervals and tests of residuals rest on.
#pragma once

namespace isotach::calibration {

// All throw std::domain_error for arguments outside the stated range, NaN among them; none returns NaN.

/// x with P(X <= x) = p of the standard normal distribution; p in (0, 1).
[[nodiscard]] double normal_quantile(double p);

/// P(X <= x) of the standard normal distribution; x any number or infinite.
[[nodiscard]] double normal_cdf(double x);

/// x with P(X <= x) = p of Student's t distribution; p in (0, 1), degrees of freedom > 0, not necessarily
/// whole; infinitely many are the normal distribution.
[[nodiscard]] double student_t_quantile(double p, double degrees);

/// x with P(X <= x) = p of the chi-squared distribution; p in [0, 1), degrees of freedom > 0 and finite.
[[nodiscard]] double chi_squared_quantile(double p, double degrees);

/// P(X > x) of the chi-squared distribution; x >= 0 and finite, degrees of freedom > 0 and finite.
[[nodiscard]] double chi_squared_survival(double x, double degrees);

}  // namespace isotach::calibration
