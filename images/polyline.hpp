// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Open lines of points in a plane.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace isotach::images {

/// Points in order; of pixels or of metres.
using Polyline = std::vector<Eigen::Vector2d>;

/// Length from the first point to each.
[[nodiscard]] std::vector<double> lengths_along(const Polyline& line);

/// `count` points (>= 2) at equal distances along the line, its ends among them.
[[nodiscard]] Polyline resampled(const Polyline& line, int count);

/// Each point moved onto the straight line that fits the points around it best, weighted by a Gaussian of
/// their distance along the line with the standard deviation `reach`. Bends draw inwards, ends stay.
[[nodiscard]] Polyline smoothed(const Polyline& line, double reach);

/// Unit directions along the line at each point, by central differences; of a line with at least two points.
[[nodiscard]] Polyline directions_along(const Polyline& line);

}  // namespace isotach::images
