// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/cell_limit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace isotach::bench {

namespace {

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Where the least-squares line through (x, y) meets x = 0.
double intercept(std::span<const double> x, std::span<const double> y) {
  const double mean_x = mean(x);
  const double mean_y = mean(y);
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  return mean_y - xy / xx * mean_x;
}

}  // namespace

CellLimit cell_limit(std::span<const double> cells, std::span<const double> values) {
  if (cells.size() < 3 || cells.size() != values.size()) {
    throw std::invalid_argument("cell_limit: at least three cells, and a value for each");
  }
  std::vector<double> squares;
  for (const double cell : cells) squares.push_back(cell * cell);
  const double first_order = intercept(cells, values);
  const double second_order = intercept(squares, values);
  CellLimit limit{0.5 * (first_order + second_order), 0.5 * std::abs(first_order - second_order)};
  for (const double value : values) {
    limit.uncertainty = std::max(limit.uncertainty, std::abs(value - limit.value));
  }
  return limit;
}

}  // namespace isotach::bench
