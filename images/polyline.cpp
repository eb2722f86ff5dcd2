// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isotach::images {

std::vector<double> lengths_along(const Polyline& line) {
  std::vector<double> lengths(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) lengths[i] = lengths[i - 1] + (line[i] - line[i - 1]).norm();
  return lengths;
}

Polyline resampled(const Polyline& line, int count) {
  const std::vector<double> lengths = lengths_along(line);
  Polyline points;
  points.reserve(static_cast<std::size_t>(count));
  std::size_t i = 0;
  for (int k = 0; k < count; ++k) {
    const double at = lengths.back() * k / (count - 1.0);
    while (i + 2 < line.size() && lengths[i + 1] < at) ++i;
    const double piece = lengths[i + 1] - lengths[i];
    const double share = piece > 0.0 ? std::clamp((at - lengths[i]) / piece, 0.0, 1.0) : 0.0;
    points.push_back(line[i] + share * (line[i + 1] - line[i]));
  }
  points.back() = line.back();  // to the last digit
  return points;
}

Polyline smoothed(const Polyline& line, double reach) {
  const std::vector<double> lengths = lengths_along(line);
  Polyline result(line.size());
  std::size_t first = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    while (lengths[i] - lengths[first] > 3.0 * reach) ++first;
    // a straight line through the neighbours, so that ends stay where they are
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    double w0 = 0.0;
    double w1 = 0.0;
    double w2 = 0.0;
    for (std::size_t k = first; k < line.size() && lengths[k] - lengths[i] <= 3.0 * reach; ++k) {
      const double u = (lengths[k] - lengths[i]) / reach;
      const double weight = std::exp(-0.5 * u * u);
      sum += weight * line[k];
      moment += weight * u * line[k];
      w0 += weight;
      w1 += weight * u;
      w2 += weight * u * u;
    }
    const double determinant = w0 * w2 - w1 * w1;
    result[i] = determinant > 1e-9 * w0 * w0 ? (w2 * sum - w1 * moment) / determinant : line[i];
  }
  return result;
}

Polyline directions_along(const Polyline& line) {
  Polyline directions(line.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = std::min(i + 1, line.size() - 1);
    directions[i] = (line[after] - line[before]).stableNormalized();
  }
  return directions;
}

}  // namespace isotach::images
