// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The line on which the mud stands, as a picture shows it.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "images/polyline.hpp"

namespace isotach::images {

/// A nearly level line, by its places on the left and on the right side of what is looked at.
struct LevelLine {
  Eigen::Vector2d left;
  Eigen::Vector2d right;

  /// Its row at a column.
  [[nodiscard]] double row(double column) const {
    return left.y() + (right.y() - left.y()) * (column - left.x()) / (right.x() - left.x());
  }
};

/// Where the background ends and the base begins.
struct GroundLine {
  LevelLine line;
  double scatter;  ///< of the readings about it, root mean square (pixels)
  double blur;     ///< standard deviation of the edge's blur (pixels)
};

/// The edge between background and base on both sides of the mud: in groups of columns, from the top, the
/// first step of `relative` (relative_light) that is at least half as high as the highest; then a line
/// through the groups of both margins and all others that agree with it. A camera at the height of the base
/// sees there the base line itself, one above it the far edge of the base. Empty where the margins show no
/// such step.
[[nodiscard]] std::optional<GroundLine> ground_line(const cv::Mat3f& relative);

/// The line through points of an edge along which a body stands, robust against a fifth of strays. Empty for
/// fewer than 10 points.
[[nodiscard]] std::optional<GroundLine> line_through(const Polyline& points, double width);

}  // namespace isotach::images
