// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What perspective adds to the radius of a body of revolution.
#pragma once

#include "images/polyline.hpp"
#include "images/view.hpp"

namespace isotach::images {

/// The meridian of a body of revolution about x = 0 from its apparent contour in the meridian plane, seen by
/// `camera`. Points (x, z) run from the foot to the axis, x >= 0 (m).
///
/// From a finite distance D one sees the body's rim not in the meridian plane but where a line of sight
/// touches it, nearer by r^2/D, so that radii seem larger by r^3/(2 D^2): 0.4 mm of 90 mm from 1 m. The line
/// of sight through a point of the contour and the contour's tangent there span a plane that touches the
/// body; the body's normal is the plane's, and the point of contact is where the line of sight meets the half
/// plane of that azimuth. Normals are those of the contour smoothed over `reach` (m). Near the top, where the
/// camera sees an edge rather than a slope, only points that go on towards the axis are kept, and the last
/// height goes on to it.
[[nodiscard]] Polyline meridian_of(const Polyline& contour, const CameraPlace& camera, double reach);

/// The distance from which a camera sees the radius (m) larger by `error` (m) at most.
[[nodiscard]] double distance_for(double radius, double error);

}  // namespace isotach::images
