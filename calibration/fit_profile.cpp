// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/fit_profile.hpp"

#include <cmath>
#include <limits>

namespace isotach::calibration {

Profile profile_of(const OedometerFit& fit, const Problem& problem, std::size_t k, double quantile,
                   const OptimiserControl& control) {
  const Uncertainty& uncertainty = fit.result.uncertainty;
  const auto i = static_cast<Eigen::Index>(k);
  const double error = uncertainty.in_null_direction(k) ? std::numeric_limits<double>::infinity()
                                                        : std::sqrt(uncertainty.covariance(i, i));
  const double ratio = std::isfinite(error) && fit.white_covariance(i, i) > 0.0
                           ? uncertainty.covariance(i, i) / fit.white_covariance(i, i)
                           : 1.0;
  return profile(problem, fit.result.main.coordinates, k, error, quantile * quantile * ratio, control);
}

}  // namespace isotach::calibration
