// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Whether residuals, in the order of reading, look like noise: runs of one sign, and autocorrelation.
#pragma once

#include <cstddef>
#include <span>

namespace isotach::calibration {

// Residuals are taken about zero, not about their mean: the residuals of an adequate model have mean zero, so
// an offset is a lack of fit and should count. All throw std::invalid_argument for a residual that is not
// finite. Scaled by one factor, residuals give the same answers.

/// Wald & Wolfowitz' (1940) test of the signs of residuals, two-sided.
struct RunsTest {
  std::size_t runs;  ///< maximal stretches of one sign; zeros are left out
  double expected;   ///< of random order
  double z;          ///< (runs - expected) in standard deviations; negative: too few runs, a trend remains
  double p_value;    ///< probability of so odd a number of runs, or odder, from noise; in [0, 1]
};

/// Given n+ positive and n- negative residuals (n together) the number of runs has mean 1 + 2 n+ n-/n and
/// variance 2 n+ n- (2 n+ n- - n)/(n^2 (n - 1)), and is taken as normal.
///
/// Where all n have one sign that says nothing; signs are then coins: runs - 1 is binomial with mean (n -
/// 1)/2 and variance (n - 1)/4, and all of one sign have the exact probability 2^(1 - n). Where the variance
/// is zero (one of each sign) or n < 2, no order is odd: z = 0, p = 1.
[[nodiscard]] RunsTest runs_test(std::span<const double> residuals);

/// Correlation of residuals `lag` apart (>= 0), sum r_i r_(i+lag) / sum r_i^2, in [-1, 1]; 0 where lag is not
/// below their number, or all are zero. Throws std::invalid_argument for a negative lag.
[[nodiscard]] double autocorrelation(std::span<const double> residuals, int lag);

/// The portmanteau test of Ljung & Box (1978).
struct LjungBox {
  int lags;          ///< correlations taken together: as asked for, but at most n/2
  double statistic;  ///< n (n + 2) sum_k rho_k^2/(n - k); chi-squared of `lags` degrees of freedom from noise
  double p_value;    ///< in [0, 1]; 1 where there are no lags
};

/// Throws std::invalid_argument for lags < 1.
[[nodiscard]] LjungBox ljung_box(std::span<const double> residuals, int lags);

}  // namespace isotach::calibration
