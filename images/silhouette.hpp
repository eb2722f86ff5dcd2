// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The mud as what stands out from the background above its base.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <tl/expected.hpp>

#include "images/base_line.hpp"
#include "images/polyline.hpp"
#include "images/refusal.hpp"

namespace isotach::images {

struct Silhouette {
  cv::Mat1f signal;  ///< about 0 on the background, about 1 on the mud
  Polyline rim;      ///< with a cut: pixels along its rim from the left foot over the top to the right foot
  Polyline lower_edge;  ///< without: its lowest pixel in each column, a tenth of them left out at either end
  double contrast;      ///< of mud and background, over the background's light
};

/// The one body in `relative` (relative_light). `cut`: what lies less than `margin` pixels above it is not
/// looked at; without it the whole picture is. A threshold by Otsu's method on how much the light differs
/// parts mud and background; along the colour in which the two then differ most, a second one gives the body,
/// its holes filled. Places are in pixels of `relative`.
///
/// Refused: a contrast below 5 % or five times the noise; more than one body, the second larger than 3 % of
/// the first; a body that reaches a side, or does not reach down to `cut`.
[[nodiscard]] tl::expected<Silhouette, Refusal> find_silhouette(const cv::Mat3f& relative,
                                                                const std::optional<LevelLine>& cut,
                                                                double margin);

}  // namespace isotach::images
