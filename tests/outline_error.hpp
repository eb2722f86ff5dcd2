// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How far a measured outline is from the true one.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bench/rendered_slump.hpp"

namespace isotach::rendered {

/// Distances of measured points from the true line (m).
struct OutlineError {
  double largest = 0.0;
  double rms = 0.0;
  double missed = 0.0;  ///< the largest distance of a true point from the measured line
};

inline double distance_to(const Outline& line, const mpm::OutlinePoint& point) {
  const Eigen::Vector2d at(point.r, point.z);
  double least = 1e9;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d a(line[i - 1].r, line[i - 1].z);
    const Eigen::Vector2d ab = Eigen::Vector2d(line[i].r, line[i].z) - a;
    const double square = ab.squaredNorm();
    const double share = square > 0.0 ? std::clamp((at - a).dot(ab) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, (at - a - share * ab).norm());
  }
  return least;
}

inline OutlineError error_of(const Outline& measured, const Outline& expected) {
  OutlineError error;
  for (const mpm::OutlinePoint& point : measured) {
    const double distance = distance_to(expected, point);
    error.largest = std::max(error.largest, distance);
    error.rms += distance * distance / static_cast<double>(measured.size());
  }
  error.rms = std::sqrt(error.rms);
  for (const mpm::OutlinePoint& point : expected) {
    error.missed = std::max(error.missed, distance_to(measured, point));
  }
  return error;
}

}  // namespace isotach::rendered
