// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/wilson.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/distributions.hpp"

namespace isotach::bench {

Interval wilson(std::size_t hits, std::size_t count) {
  const double z = calibration::normal_quantile(0.975);
  const auto n = static_cast<double>(count);
  const double p = static_cast<double>(hits) / n;
  const double centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace isotach::bench
