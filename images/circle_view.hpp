// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The view by a circle of known diameter.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "images/view.hpp"

namespace isotach::images {

/// Residuals of the points on the circle after the fit tell how well it was read.
struct CircleView {
  View view;
  double scatter;    ///< root mean square distance of the points from the circle (m)
  double elevation;  ///< of the camera as seen from the circle's middle (rad); of a disc: its tilt
};

/// A circle drawn on the base about the axis, seen by a camera at `camera_distance` (horizontally from the
/// axis, m): five or more points on it in a picture of `size`, the principal point in its middle, pixels
/// square. Height, direction and focal length of the camera follow, so that axis and base are known: x is 0
/// on the axis. Empty with fewer points, where they are on no ellipse, or where the fit does not settle.
[[nodiscard]] std::optional<CircleView> base_circle_view(const std::vector<Eigen::Vector2d>& points,
                                                         double diameter, cv::Size size,
                                                         double camera_distance);

/// A disc that stood in the meridian plane, by five or more points on its rim. Its image is taken for that of
/// a parallel projection: what tilt shortens is stretched again, but that the far side looks smaller is left,
/// an error of sin(tilt) times half the picture's width over the distance. The base is not known.
[[nodiscard]] std::optional<CircleView> standing_disc_view(const std::vector<Eigen::Vector2d>& points,
                                                           double diameter, cv::Size size,
                                                           std::optional<double> camera_distance);

}  // namespace isotach::images
