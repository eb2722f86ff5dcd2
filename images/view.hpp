// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How the meridian plane of the slump stands in a picture.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

namespace isotach::images {

/// The camera's centre, seen from the meridian plane.
struct CameraPlace {
  double distance;  ///< from the plane (m), > 0
  double x;         ///< along the plane, to the right as the picture shows it (m)
  double z;         ///< above the base (m)
};

/// A view of the meridian plane: the vertical plane through the axis of the slump that faces the camera, x to
/// the right and z upwards (m). Straight lines are straight in the picture: the lens does not distort.
class View {
 public:
  /// `to_plane` takes (column, row, 1) to homogeneous x and z. `base_known`: z is 0 on the base; otherwise
  /// its zero has no meaning yet.
  View(const Eigen::Matrix3d& to_plane, bool base_known, std::optional<CameraPlace> camera = {});

  [[nodiscard]] Eigen::Vector2d plane(const Eigen::Vector2d& pixel) const;
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& place) const;
  /// Metres a pixel at a pixel: the root of the area that it shows.
  [[nodiscard]] double scale(const Eigen::Vector2d& pixel) const;
  [[nodiscard]] bool base_known() const { return base_known_; }
  /// Where it is known; its z only where the base is.
  [[nodiscard]] const std::optional<CameraPlace>& camera() const { return camera_; }

  /// The same view, turned and shifted in its plane so that the base line through two pixels, from left to
  /// right, has z = 0, and its left one x = 0.
  [[nodiscard]] View based_on(const Eigen::Vector2d& left, const Eigen::Vector2d& right) const;

 private:
  Eigen::Matrix3d to_plane_;
  Eigen::Matrix3d to_pixel_;
  bool base_known_;
  std::optional<CameraPlace> camera_;
};

/// A camera whose line of sight meets the meridian plane at a right angle in the middle of a picture of
/// `size`: `scale` metres a pixel everywhere. `camera_distance` (m) may be known.
[[nodiscard]] View level_view(double scale, cv::Size size, std::optional<double> camera_distance);

/// Any camera, by a rectangle of `width` by `height` (m) that stood in the meridian plane with its lower side
/// on the base: `corners` are upper left, upper right, lower right, lower left. With `camera_distance` the
/// camera's place follows, its principal point in the middle of the picture and its pixels square. Empty
/// where the corners are not those of a convex four-sided figure in this order.
[[nodiscard]] std::optional<View> rectangle_view(const std::array<Eigen::Vector2d, 4>& corners, double width,
                                                 double height, cv::Size size,
                                                 std::optional<double> camera_distance);

/// The middle of a picture of that size.
[[nodiscard]] Eigen::Vector2d middle_of(cv::Size size);

}  // namespace isotach::images
