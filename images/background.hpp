// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the background's light would be where the mud hides it.
#pragma once

#include <opencv2/core.hpp>

namespace isotach::images {

/// The light of each channel over that of the background, less 1: 0 on an even background whatever the lamp,
/// negative where the picture is darker. The background is smooth: in each channel the logarithm of its light
/// is a cubic in column and row, fitted (least absolute residuals, then Tukey's biweight) to what looks like
/// the upper and upper outer margins, where no mud is expected. Pixels whose `ignored` is not 0 do not count
/// and become 0; where they are all of the margins, everything does.
[[nodiscard]] cv::Mat3f relative_light(const cv::Mat3f& light, const cv::Mat1b& ignored);

}  // namespace isotach::images
