// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/block_bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isotach::calibration {

std::vector<std::size_t> resample_blocks(std::size_t count, std::size_t block, std::mt19937_64& generator) {
  if (block == 0) throw std::invalid_argument("a block of length 0");
  std::vector<std::size_t> indices(count);
  if (count == 0) return indices;
  std::uniform_int_distribution<std::size_t> anywhere(0, count - 1);
  std::bernoulli_distribution ends(1.0 / static_cast<double>(block));
  for (std::size_t i = 0; i < count; ++i) {
    indices[i] = i == 0 || ends(generator) ? anywhere(generator) : (indices[i - 1] + 1) % count;
  }
  return indices;
}

std::size_t block_length(double rho, std::size_t n, double serial_share) {
  if (!(std::abs(rho) < 1.0)) throw std::invalid_argument("a correlation outside (-1, 1)");
  if (!(serial_share >= 0.0 && serial_share <= 1.0)) {
    throw std::invalid_argument("a serial share outside [0, 1]");
  }
  if (n == 0) throw std::invalid_argument("a block length for no values");
  const auto count = static_cast<double>(n);
  const double lasting = std::abs(rho);
  const double spread = 2.0 * serial_share * lasting / (1.0 - lasting);  // G (1 - rho)
  const double sum = (1.0 - serial_share) * (1.0 - lasting) + serial_share * (1.0 + lasting);
  const double best = std::pow(spread / sum, 2.0 / 3.0) * std::cbrt(count);
  const double most = std::min(3.0 * std::sqrt(count), count / 3.0);
  return static_cast<std::size_t>(std::ceil(std::max(1.0, std::min(best, most))));
}

}  // namespace isotach::calibration
