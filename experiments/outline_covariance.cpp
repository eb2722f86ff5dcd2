// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/outline_covariance.hpp"

#include <cmath>

namespace isotach::experiments {

namespace {

constexpr double kFirstTime = 0.1;  // s, below which all times count as one

double shared(const SharedError& error, const OutlineStation& a, bool a_gone, const OutlineStation& b,
              bool b_gone) {
  const double size = error.size_of(a.outline, a_gone) * error.size_of(b.outline, b_gone);
  if (size == 0.0) return 0.0;
  return size * std::exp(-std::abs(a.place - b.place) / error.along -
                         std::abs(std::log((a.time + kFirstTime) / (b.time + kFirstTime))) / error.in_time);
}

}  // namespace

Eigen::MatrixXd station_covariance(std::span<const OutlineStation> stations, const std::vector<bool>& gone,
                                   const OutlineErrors& errors) {
  const auto n = static_cast<Eigen::Index>(stations.size());
  Eigen::MatrixXd covariance(n, n);
  for (std::size_t a = 0; a < stations.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      double value = shared(errors.measuring, stations[a], gone[a], stations[b], gone[b]) +
                     shared(errors.simulation, stations[a], gone[a], stations[b], gone[b]);
      if (a == b) value += errors.reading * errors.reading / static_cast<double>(stations[a].points.size());
      const auto i = static_cast<Eigen::Index>(a);
      const auto j = static_cast<Eigen::Index>(b);
      covariance(i, j) = covariance(j, i) = value;
    }
  }
  return covariance;
}

}  // namespace isotach::experiments
