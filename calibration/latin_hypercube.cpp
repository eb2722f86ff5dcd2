// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/latin_hypercube.hpp"

#include <numeric>
#include <utility>

namespace isotach::calibration {

namespace {

/// Uniform in [0, 1), the same on every platform.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1.0p-53;
}

}  // namespace

std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimension,
                                                 std::mt19937_64& random) {
  std::vector<std::vector<double>> points(count, std::vector<double>(dimension));
  std::vector<std::size_t> order(count);
  for (std::size_t k = 0; k < dimension; ++k) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {
      std::swap(order[i - 1], order[static_cast<std::size_t>(uniform(random) * static_cast<double>(i))]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      points[i][k] = (static_cast<double>(order[i]) + uniform(random)) / static_cast<double>(count);
    }
  }
  return points;
}

}  // namespace isotach::calibration
