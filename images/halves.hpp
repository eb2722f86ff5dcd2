// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The outline seen as two halves about an axis, and their mean.
#pragma once

#include <optional>
#include <vector>

#include "images/polyline.hpp"
#include "images/view.hpp"

namespace isotach::images {

/// The vertical axis of symmetry of an area in the meridian plane.
struct Axis {
  double x;     ///< of the area's centre (m)
  double lean;  ///< of the line through the middles of its widths, by least squares, to the right (rad)
};

/// The axis of what lies between a line from the left to the right foot and the base z = 0.
[[nodiscard]] Axis axis_of(const Polyline& outline);

/// Both halves from toe to axis: places are (r, z), r >= 0 to the respective side (m).
struct Halves {
  Polyline left;
  Polyline right;
};

/// Parts the outline where it crosses the axis, at the highest such place. Empty where it does not.
[[nodiscard]] std::optional<Halves> halves_about(const Polyline& outline, double axis);

/// The half with its foot brought down to the base z = 0 along the direction of its lowest `length` (m), no
/// flatter than 10 degrees.
[[nodiscard]] Polyline with_foot(const Polyline& half, double length);

/// Both halves as a camera at the place (x from the axis) sees them, made those of the body.
[[nodiscard]] Halves meridians_of(const Halves& apparent, const CameraPlace& camera, double reach);

/// A point of the mean of both halves.
struct MeanPoint {
  Eigen::Vector2d place;   ///< (r, z) (m)
  double half_difference;  ///< along the normal (m): right half further out is positive
  Eigen::Vector2d left;    ///< what was averaged
  Eigen::Vector2d right;
};

/// The mean of points at equal shares of either half's length, about `spacing` (m) apart, from toe to axis.
[[nodiscard]] std::vector<MeanPoint> mean_of(const Halves& halves, double spacing);

}  // namespace isotach::images
