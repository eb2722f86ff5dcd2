// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "images/body.hpp"

namespace isotach::images {
namespace {

constexpr double kFootLength = 1.5e-3;    // m, from which the foot is extrapolated to the base
constexpr double kFootPixels = 6.0;       // at least
constexpr double kNormalsReach = 1.5e-3;  // m, smoothing before normals are taken
constexpr double kNormalsPixels = 4.0;    // at least
// beyond these an outline comes with a warning
constexpr double kUnclear = 0.05;                         // of the rim
constexpr double kHidden = 3e-3;                          // m
constexpr double kAsymmetry = 2e-3;                       // m
constexpr double kLean = 2.0 * std::numbers::pi / 180.0;  // rad
constexpr double kLowContrast = 0.10;                     // of the background's light

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMillimetres = 1e3;

/// The base line where something else than the picture itself says it.
std::optional<LevelLine> known_base(const Picture& picture, const View& view, const ProfileOptions& options) {
  const double last = picture.codes.cols - 1.0;
  if (options.base_row) return LevelLine{{0.0, *options.base_row}, {last, *options.base_row}};
  if (!view.base_known()) return {};
  // the pixels of two places of the base near the sides of the picture
  const Eigen::Vector2d left = view.pixel({view.plane({0.0, 0.5 * picture.codes.rows}).x(), 0.0});
  const Eigen::Vector2d right = view.pixel({view.plane({last, 0.5 * picture.codes.rows}).x(), 0.0});
  const LevelLine line{left, right};
  return LevelLine{{0.0, line.row(0.0)}, {last, line.row(last)}};
}

std::vector<std::string> warnings_of(const Reading& reading, double unclear) {
  std::vector<std::string> warnings;
  if (unclear > kUnclear) {
    warnings.push_back(
        fmt::format("{:.0f} % of the edge is unclear and bridged by a straight line", 100.0 * unclear));
  }
  if (reading.hidden > kHidden) {
    warnings.push_back(
        fmt::format("the lowest {:.1f} mm are hidden and extrapolated", kMillimetres * reading.hidden));
  }
  if (reading.asymmetry > kAsymmetry) {
    warnings.push_back(fmt::format("left and right differ by {:.1f} mm (root mean square of half of it)",
                                   kMillimetres * reading.asymmetry));
  }
  if (std::abs(reading.lean) > kLean) {
    warnings.push_back(fmt::format("the axis leans by {:.1f} degrees to the {}",
                                   kDegrees * std::abs(reading.lean), reading.lean > 0.0 ? "right" : "left"));
  }
  if (reading.contrast < kLowContrast) {
    warnings.push_back(fmt::format("the mud differs from the background by only {:.0f} % of its light",
                                   100.0 * reading.contrast));
  }
  return warnings;
}

std::optional<Refusal> volume_refusal(const Reading& reading, const ProfileOptions& options) {
  if (!reading.volume_error || std::abs(*reading.volume_error) <= options.volume_limit) return {};
  return Refusal{
      Refusal::Kind::volume,
      fmt::format("the volume of revolution is {:.1f} ml, {:+.1f} % off the {:.1f} ml filled in; at most "
                  "{:g} % is taken (see --volume-limit-percent)",
                  1e6 * reading.volume, 100.0 * *reading.volume_error, 1e6 * *options.mould_volume,
                  100.0 * options.volume_limit)};
}

}  // namespace

PictureOutcome read_profile(const Picture& picture, const View& view, const ProfileOptions& options) {
  BodyOutcome found = find_body(picture, options.looked, known_base(picture, view, options));
  if (!found.body) return {tl::unexpected(found.body.error()), found.marks};
  const Body& body = *found.body;
  const bool base_by_view = view.base_known() && !options.base_row;
  const View based = base_by_view ? view : view.based_on(body.base.left, body.base.right);

  Polyline outline;
  for (const Eigen::Vector2d& point : body.edge.points) outline.push_back(based.plane(point));
  Axis axis = axis_of(outline);
  if (options.axis_column)
    axis.x = based.plane({*options.axis_column, body.base.row(*options.axis_column)}).x();
  const double pixel = based.scale(based.pixel({axis.x, 0.0}));
  std::optional<Halves> halves = halves_about(outline, axis.x);
  if (!halves) {
    return {tl::unexpected(Refusal{Refusal::Kind::unclear_edge, "the outline does not cross its axis"}),
            found.marks};
  }
  double top = 0.0;
  for (const Eigen::Vector2d& point : outline) top = std::max(top, point.y());
  found.marks.axis.emplace(based.pixel({axis.x, 0.0}), based.pixel({axis.x, top}));
  if (const auto& camera = based.camera()) {
    halves = meridians_of(*halves, {camera->distance, camera->x - axis.x, camera->z},
                          std::max(kNormalsReach, kNormalsPixels * pixel));
  }

  const double foot = std::max(kFootLength, kFootPixels * pixel);
  halves = Halves{with_foot(halves->left, foot), with_foot(halves->right, foot)};

  Reading reading{};
  reading.points = mean_of(*halves, options.spacing);
  double square = 0.0;
  for (const MeanPoint& point : reading.points) {
    reading.outline.points.push_back({point.place.x(), point.place.y()});
    square += point.half_difference * point.half_difference;
  }
  reading.asymmetry = std::sqrt(square / static_cast<double>(reading.points.size()));
  reading.volume = reading.outline.volume();
  if (options.mould_volume) reading.volume_error = reading.volume / *options.mould_volume - 1.0;
  reading.lean = axis.lean;
  const Eigen::Vector2d along = body.base.right - body.base.left;
  reading.base_tilt = std::atan2(along.y(), along.x());
  reading.hidden = std::max(0.0, 0.5 * (outline.front().y() + outline.back().y()));
  reading.pixel = pixel;
  reading.blur = pixel * body.edge.blur;
  reading.contrast = body.contrast;
  reading.warnings = warnings_of(reading, body.edge.unclear);
  if (auto refusal = volume_refusal(reading, options)) {
    return {tl::unexpected(std::move(*refusal)), found.marks};
  }
  return {std::move(reading), found.marks};
}

}  // namespace isotach::images
