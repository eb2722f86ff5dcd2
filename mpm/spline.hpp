// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Quadratic B-spline weights of a point on a regular row of nodes.
#pragma once

#include <array>

namespace isotach::mpm {

/// The three nodes a point touches: indices base .. base + 2, weights and offsets node - point in cells.
struct SplineWeights {
  int base;
  std::array<double, 3> weight;
  std::array<double, 3> offset;
};

/// Weights at `position` >= 0.5, measured in cells from node 0. Sum 1, first moment 0, second moment 1/4.
[[nodiscard]] inline SplineWeights spline_weights(double position) {
  SplineWeights s;
  s.base = static_cast<int>(position - 0.5);
  const double f = position - s.base;  // in [0.5, 1.5)
  s.weight = {0.5 * (1.5 - f) * (1.5 - f), 0.75 - (f - 1.0) * (f - 1.0), 0.5 * (f - 0.5) * (f - 0.5)};
  s.offset = {-f, 1.0 - f, 2.0 - f};
  return s;
}

}  // namespace isotach::mpm
