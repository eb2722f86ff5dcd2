// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/mould_picture.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "images/body.hpp"

namespace isotach::images {
namespace {

constexpr double kLowest = 0.2;  // of the height; the rim and what holds it are left out
constexpr double kHighest = 0.8;
constexpr double kStray = 3.0;  // pixels off the line beyond which an edge is no wall

/// A wall as columns along the height: column = at + slope * height (pixels).
struct Wall {
  double at;
  double slope;
  double scatter;
};

std::optional<Wall> wall_of(const Polyline& points) {  // (column, height)
  constexpr std::size_t kLeast = 10;
  Polyline chosen = points;
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  double scatter = 0.0;
  for (int pass = 0; pass < 3; ++pass) {
    if (chosen.size() < kLeast) return {};
    const auto n = static_cast<Eigen::Index>(chosen.size());
    Eigen::MatrixX2d matrix(n, 2);
    Eigen::VectorXd columns(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      matrix.row(i) << 1.0, chosen[static_cast<std::size_t>(i)].y();
      columns(i) = chosen[static_cast<std::size_t>(i)].x();
    }
    line = matrix.colPivHouseholderQr().solve(columns);
    scatter = (columns - matrix * line).norm() / std::sqrt(static_cast<double>(n));
    std::erase_if(chosen, [&](const Eigen::Vector2d& point) {
      return std::abs(point.x() - line(0) - line(1) * point.y()) > kStray;
    });
  }
  return Wall{line(0), line(1), scatter};
}

}  // namespace

tl::expected<MouldWidth, Refusal> mould_width(const Picture& picture, const Looked& looked) {
  const BodyOutcome found = find_body(picture, looked, {});
  if (!found.body) return tl::unexpected(found.body.error());
  const Body& body = *found.body;
  // along and across the base line, about its left end
  const Eigen::Vector2d along = (body.base.right - body.base.left).normalized();
  const Eigen::Vector2d up(along.y(), -along.x());
  double height = 0.0;
  double middle = 0.0;
  for (const Eigen::Vector2d& point : body.edge.points) {
    height = std::max(height, (point - body.base.left).dot(up));
    middle += (point - body.base.left).dot(along) / static_cast<double>(body.edge.points.size());
  }
  Polyline left;
  Polyline right;
  for (const Eigen::Vector2d& point : body.edge.points) {
    const Eigen::Vector2d at((point - body.base.left).dot(along), (point - body.base.left).dot(up));
    if (at.y() < kLowest * height || at.y() > kHighest * height) continue;
    (at.x() < middle ? left : right).push_back(at);
  }
  const auto left_wall = wall_of(left);
  const auto right_wall = wall_of(right);
  if (!left_wall || !right_wall) {
    return tl::unexpected(Refusal{Refusal::Kind::unclear_edge, "the mould's walls are not straight lines"});
  }
  const double at = 0.5 * (kLowest + kHighest) * height;
  const double slope = right_wall->slope - left_wall->slope;
  const double across = right_wall->at - left_wall->at + slope * at;
  // square to the walls, should they lean
  const double lean = std::atan(0.5 * (right_wall->slope + left_wall->slope));
  return MouldWidth{across * std::cos(lean), std::hypot(left_wall->scatter, right_wall->scatter),
                    slope * height / across};
}

double scale_of(const MouldWidth& width, double diameter, std::optional<double> distance) {
  const double radius = 0.5 * diameter;
  const double seen = distance ? diameter / std::sqrt(1.0 - std::pow(radius / *distance, 2)) : diameter;
  return seen / width.pixels;
}

}  // namespace isotach::images
