// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/residual_tests.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "calibration/distributions.hpp"

namespace isotach::calibration {

namespace {

void require_finite(std::span<const double> residuals) {
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!std::isfinite(residuals[i])) {
      throw std::invalid_argument("residual " + std::to_string(i) + " is not finite");
    }
  }
}

double largest(std::span<const double> residuals) {
  double result = 0.0;
  for (const double r : residuals) result = std::max(result, std::abs(r));
  return result;
}

}  // namespace

RunsTest runs_test(std::span<const double> residuals) {
  require_finite(residuals);
  std::size_t positive = 0;
  std::size_t negative = 0;
  std::size_t runs = 0;
  double before = 0.0;
  for (const double r : residuals) {
    if (r == 0.0) continue;
    ++(r > 0.0 ? positive : negative);
    if (runs == 0 || (r > 0.0) != (before > 0.0)) ++runs;
    before = r;
  }
  const auto n = static_cast<double>(positive + negative);
  const auto found = static_cast<double>(runs);
  if (n < 2.0) return {runs, n, 0.0, 1.0};
  if (positive == 0 || negative == 0) {
    return {runs, 0.5 * (n + 1.0), -std::sqrt(n - 1.0), std::exp2(1.0 - n)};
  }
  const double pairs = 2.0 * static_cast<double>(positive) * static_cast<double>(negative);
  const double expected = 1.0 + pairs / n;
  const double variance = pairs * (pairs - n) / (n * n * (n - 1.0));
  if (!(variance > 0.0)) return {runs, expected, 0.0, 1.0};
  const double z = (found - expected) / std::sqrt(variance);
  return {runs, expected, z, 2.0 * normal_cdf(-std::abs(z))};
}

double autocorrelation(std::span<const double> residuals, int lag) {
  if (lag < 0) throw std::invalid_argument("lag " + std::to_string(lag) + " is negative");
  require_finite(residuals);
  const auto apart = static_cast<std::size_t>(lag);
  const double scale = largest(residuals);  // squares then neither overflow nor vanish
  if (scale == 0.0 || apart >= residuals.size()) return 0.0;
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double r = residuals[i] / scale;
    squares += r * r;
    if (i + apart < residuals.size()) products += r * (residuals[i + apart] / scale);
  }
  return products / squares;
}

LjungBox ljung_box(std::span<const double> residuals, int lags) {
  if (lags < 1)
    throw std::invalid_argument(std::to_string(lags) + " lags are not admissible; accepted: >= 1");
  require_finite(residuals);
  const auto half = residuals.size() / 2;
  LjungBox result{static_cast<int>(std::min(half, static_cast<std::size_t>(lags))), 0.0, 1.0};
  if (result.lags == 0) return result;
  const auto n = static_cast<double>(residuals.size());
  for (int k = 1; k <= result.lags; ++k) {
    const double rho = autocorrelation(residuals, k);
    result.statistic += n * (n + 2.0) * rho * rho / (n - k);
  }
  result.p_value = chi_squared_survival(result.statistic, result.lags);
  return result;
}

}  // namespace isotach::calibration
