// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Measured outlines parted into stretches of equal length: what a fit compares.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "datasets/outline.hpp"
#include "mpm/outline.hpp"

namespace isotach::experiments {

/// A stretch of a measured outline with the points on it. Its value is the mean of theirs, so that a part of
/// the surface that was read more closely weighs no more than its length.
struct OutlineStation {
  std::size_t outline = 0;          ///< which of the test's
  double time = 0.0;                ///< s
  double place = 0.0;               ///< of its middle: arc length from the toe over that of the whole outline
  std::vector<std::size_t> points;  ///< of the test, counted through all outlines; at least one
};

/// Stretches of about `spacing` (m) of all outlines, from toe to axis, in the order of the outlines; a
/// stretch without points is none.
[[nodiscard]] std::vector<OutlineStation> outline_stations(const std::vector<datasets::Outline>& outlines,
                                                           double spacing);

/// The mean of `values` (one a point) on each station.
[[nodiscard]] std::vector<double> station_means(std::span<const OutlineStation> stations,
                                                std::span<const double> values);

/// n >= 2 points at equal arc lengths of a polyline, its ends among them.
[[nodiscard]] std::vector<mpm::OutlinePoint> resampled(std::span<const mpm::OutlinePoint> polyline,
                                                       std::size_t n);

}  // namespace isotach::experiments
