// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The edge of the mud to a fraction of a pixel.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "images/base_line.hpp"
#include "images/polyline.hpp"

namespace isotach::images {

struct Edge {
  Polyline points;  ///< about a pixel apart, in the order of the rim, unclear ones left out
  double blur;      ///< standard deviation of the edge's blur, the median (pixels)
  double unclear;   ///< share of the rim where no edge was found, or one that its neighbours contradict
};

/// Moves a `rim`, which has the mud on its right as rows run downwards, to where `signal` (Silhouette) passes
/// the middle between mud and background: along the normal, averaged over five pixels along the rim, between
/// the medians of what lies four to eight pixels off on either side. So neither blur nor slow changes of
/// light shift it. Twice, the second time along the normals of what the first found. Nothing below `cut`
/// counts.
[[nodiscard]] Edge locate_edge(const cv::Mat1f& signal, const Polyline& rim,
                               const std::optional<LevelLine>& cut);

}  // namespace isotach::images
