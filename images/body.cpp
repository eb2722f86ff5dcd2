// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "images/background.hpp"
#include "images/silhouette.hpp"

namespace isotach::images {
namespace {

constexpr double kLeastMargin = 3.0;      // pixels above the cut that are not looked at
constexpr double kMarginInBlurs = 2.5;    // of the edge of the base, so that its light does not reach further
constexpr double kMostUnclear = 0.25;     // of the rim
constexpr double kMostBaseScatter = 3.0;  // pixels

LevelLine shifted(LevelLine line, const Eigen::Vector2d& by) {
  line.left += by;
  line.right += by;
  return line;
}

/// The upper of both lines on each side.
LevelLine upper_of(const LevelLine& a, const LevelLine& b) {
  return {{a.left.x(), std::min(a.left.y(), b.row(a.left.x()))},
          {a.right.x(), std::min(a.right.y(), b.row(a.right.x()))}};
}

cv::Mat1b ignored_in(const PixelArea& region, const Looked& looked) {
  cv::Mat1b mask(region.height, region.width, static_cast<unsigned char>(0));
  for (const PixelArea& area : looked.ignored) {
    const cv::Rect inside =
        cv::Rect(area.column - region.column, area.row - region.row, area.width, area.height) &
        cv::Rect(0, 0, region.width, region.height);
    if (!inside.empty()) mask(inside) = 255;
  }
  return mask;
}

/// The base by the lower edge of a body where no base stands out from the background.
std::optional<LevelLine> base_below(const Silhouette& silhouette) {
  Polyline lower = silhouette.lower_edge;
  if (lower.size() < 3) return {};
  std::reverse(lower.begin(), lower.end());  // the mud on its right
  const Edge edge = locate_edge(silhouette.signal, lower, {});
  const std::optional<GroundLine> line = line_through(edge.points, silhouette.signal.cols);
  if (!line || line->scatter > kMostBaseScatter) return {};
  return line->line;
}

}  // namespace

BodyOutcome find_body(const Picture& picture, const Looked& looked, const std::optional<LevelLine>& base) {
  const PixelArea region = looked_area(picture, looked);
  const Eigen::Vector2d origin(region.column, region.row);
  const cv::Rect rectangle(region.column, region.row, region.width, region.height);
  const cv::Mat3f relative = relative_light(light_of(picture.codes(rectangle)), ignored_in(region, looked));

  Marks marks{{}, base, {}, {}};
  const std::optional<GroundLine> ground = ground_line(relative);
  std::optional<LevelLine> local_base;
  if (base) local_base = shifted(*base, -origin);
  double margin = kLeastMargin;
  std::optional<LevelLine> cut = local_base;
  if (ground) {
    margin = std::max(margin, 2.0 + kMarginInBlurs * ground->blur);
    if (!local_base) local_base = ground->line;
    cut = upper_of(ground->line, *local_base);
  }
  if (!cut) {
    const auto whole = find_silhouette(relative, {}, 0.0);
    if (!whole) return {tl::unexpected(whole.error()), marks};
    local_base = base_below(*whole);
    if (!local_base) {
      return {
          tl::unexpected(Refusal{Refusal::Kind::no_base_line,
                                 "no base stands out beside the mud, and the lower edge of the mud is not "
                                 "straight; give --base-row or --rectangle"}),
          marks};
    }
    cut = local_base;
  }
  marks.base = shifted(*local_base, origin);
  marks.cut = shifted(*cut, origin);

  const auto silhouette = find_silhouette(relative, cut, margin);
  if (!silhouette) return {tl::unexpected(silhouette.error()), marks};
  Edge edge = locate_edge(silhouette->signal, silhouette->rim, cut);
  for (Eigen::Vector2d& point : edge.points) point += origin;
  marks.edge = edge.points;
  if (edge.unclear > kMostUnclear || edge.points.size() < 3) {
    return {tl::unexpected(Refusal{
                Refusal::Kind::unclear_edge,
                fmt::format("{:.0f} % of the edge is blurred, hidden or broken; at most {:.0f} % is taken",
                            100.0 * edge.unclear, 100.0 * kMostUnclear)}),
            marks};
  }
  return {Body{std::move(edge), *marks.base, *marks.cut, silhouette->contrast}, marks};
}

}  // namespace isotach::images
