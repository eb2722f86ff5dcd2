// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/apparent_contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isotach::images {
namespace {

constexpr double kAxisInReaches = 3.0;    // of smoothing, from the axis, in which normals are not used
constexpr double kFlat = 0.7;             // upward part of a normal above which a surface counts as top
constexpr double kTopReach = 1.5;         // times the reach, of smoothing the top, whose normals count most
constexpr double kNormalError = 2e-3;     // of a normal that is read so
constexpr double kHeightError = 0.15e-3;  // m, that it may make of the height of a point of the top

/// The point of contact on the line of sight through `seen`, as radius and height.
Eigen::Vector2d contact(const Eigen::Vector2d& seen, const Eigen::Vector2d& normal, const CameraPlace& camera,
                        double furthest) {
  const double x = seen.x() - camera.x;
  const double z = seen.y() - camera.z;
  // the plane's normal, n.x + n.z + depth towards the camera, is square to the line of sight
  const double towards = (normal.x() * x + normal.y() * z) / camera.distance;
  const double below = camera.distance * normal.x() + x * towards;
  const double above = camera.distance * normal.x() - camera.x * towards;
  // 1 in the meridian plane, less nearer to the camera; no further from the plane than the body is wide
  const double bound = furthest / camera.distance;
  const double along = std::abs(below) > 0.0 ? std::clamp(above / below, 1.0 - bound, 1.0 + bound) : 1.0;
  const double depth = camera.distance * (1.0 - along);
  return {std::hypot(camera.x + along * x, depth), camera.z + along * z};
}

}  // namespace

Polyline meridian_of(const Polyline& contour, const CameraPlace& camera, double reach) {
  const Polyline along = directions_along(smoothed(contour, reach));
  const Polyline along_top = directions_along(smoothed(contour, kTopReach * reach));
  double furthest = 0.0;
  for (const Eigen::Vector2d& point : contour) furthest = std::max(furthest, point.x());
  Polyline meridian;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    // at the axis where a line of sight touches the body follows from no normal, near it from none that is
    // read
    if (contour[i].x() < kAxisInReaches * reach) continue;
    const bool top = -along[i].x() > kFlat;
    const Eigen::Vector2d& direction = top ? along_top[i] : along[i];
    const Eigen::Vector2d outwards(direction.y(), -direction.x());
    const Eigen::Vector2d point = contact(contour[i], outwards, camera, furthest);
    if (top && !meridian.empty()) {
      const double put_right = std::abs(point.y() - contour[i].y());
      const bool unsure = put_right * kNormalError > kHeightError * std::abs(outwards.x());
      if (unsure || point.x() >= meridian.back().x()) continue;
    }
    meridian.push_back(point);
  }
  if (meridian.empty()) return contour;
  meridian.emplace_back(0.0, meridian.back().y());
  return meridian;
}

double distance_for(double radius, double error) {
  return std::sqrt(radius * radius * radius / (2.0 * error));
}

}  // namespace isotach::images
