// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/halves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "images/apparent_contour.hpp"

namespace isotach::images {
namespace {

constexpr double kFlattestFoot = 10.0 * std::numbers::pi / 180.0;
constexpr int kLeastPoints = 25;  // of a mean outline

/// Right of the axis, mirrored where it is the left half.
Eigen::Vector2d beside(const Eigen::Vector2d& point, double axis, double side) {
  return {side * (point.x() - axis), point.y()};
}

}  // namespace

Axis axis_of(const Polyline& outline) {
  // about the first point and in millimetres: OpenCV holds the polygon in single precision
  const Eigen::Vector2d origin = outline.front();
  std::vector<cv::Point2f> polygon;
  const auto add = [&](double x, double z) {
    polygon.emplace_back(static_cast<float>(1e3 * (x - origin.x())), static_cast<float>(1e3 * z));
  };
  add(outline.front().x(), 0.0);
  for (const Eigen::Vector2d& point : outline) add(point.x(), point.y());
  add(outline.back().x(), 0.0);
  const cv::Moments moments = cv::moments(polygon);
  return {origin.x() + 1e-3 * moments.m10 / moments.m00, std::atan(moments.mu11 / moments.mu02)};
}

std::optional<Halves> halves_about(const Polyline& outline, double axis) {
  std::optional<std::size_t> crossing;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    if (!(outline[i].x() < axis && outline[i + 1].x() >= axis)) continue;
    if (!crossing || outline[i].y() > outline[*crossing].y()) crossing = i;
  }
  if (!crossing || *crossing < 2 || *crossing + 4 > outline.size()) return {};
  const Eigen::Vector2d& a = outline[*crossing];
  const Eigen::Vector2d& b = outline[*crossing + 1];
  const double share = (axis - a.x()) / (b.x() - a.x());
  const Eigen::Vector2d top(0.0, a.y() + share * (b.y() - a.y()));
  Halves halves;
  for (std::size_t i = 0; i <= *crossing; ++i) halves.left.push_back(beside(outline[i], axis, -1.0));
  for (std::size_t i = outline.size() - 1; i > *crossing; --i) {
    halves.right.push_back(beside(outline[i], axis, 1.0));
  }
  halves.left.push_back(top);
  halves.right.push_back(top);
  return halves;
}

Halves meridians_of(const Halves& apparent, const CameraPlace& camera, double reach) {
  const CameraPlace mirrored{camera.distance, -camera.x, camera.z};
  return {meridian_of(apparent.left, mirrored, reach), meridian_of(apparent.right, camera, reach)};
}

Polyline with_foot(const Polyline& half, double length) {
  Polyline line = half;
  while (line.size() > 2 && line.front().y() <= 0.0) line.erase(line.begin());
  std::size_t last = 1;
  const std::vector<double> lengths = lengths_along(line);
  while (last + 1 < line.size() && lengths[last] < length) ++last;
  // least squares across the line, so that a steep and a flat foot are one case
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i <= last; ++i) mean += line[i] / static_cast<double>(last + 1);
  double xx = 0.0;
  double xz = 0.0;
  double zz = 0.0;
  for (std::size_t i = 0; i <= last; ++i) {
    const Eigen::Vector2d off = line[i] - mean;
    xx += off.x() * off.x();
    xz += off.x() * off.y();
    zz += off.y() * off.y();
  }
  double angle = 0.5 * std::atan2(2.0 * xz, xx - zz);  // of the line, from the horizontal
  if (angle < 0.0) angle += std::numbers::pi;
  angle = std::clamp(angle, kFlattestFoot, std::numbers::pi - kFlattestFoot);
  const double height = line.front().y();
  line.insert(line.begin(), {line.front().x() - height / std::tan(angle), 0.0});
  return line;
}

std::vector<MeanPoint> mean_of(const Halves& halves, double spacing) {
  const double length = 0.5 * (lengths_along(halves.left).back() + lengths_along(halves.right).back());
  const int count = std::max(kLeastPoints, 1 + static_cast<int>(std::lround(length / spacing)));
  const Polyline left = resampled(halves.left, count);
  const Polyline right = resampled(halves.right, count);
  Polyline mean;
  for (std::size_t i = 0; i < left.size(); ++i) mean.emplace_back(0.5 * (left[i] + right[i]));
  const Polyline along = directions_along(mean);
  std::vector<MeanPoint> points;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const Eigen::Vector2d outwards(along[i].y(), -along[i].x());
    points.push_back({mean[i], 0.5 * (right[i] - left[i]).dot(outwards), left[i], right[i]});
  }
  return points;
}

}  // namespace isotach::images
