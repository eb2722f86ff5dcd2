// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The stretches of one rate that a strain-controlled test's loading consists of.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/compression_curve.hpp"

namespace isotach::calibration {

/// Consecutive points of one loading segment, compressed at one rate.
struct RateBlock {
  std::size_t first;  ///< index into the curve
  std::size_t count;  ///< >= 3
  double rate;        ///< 1/s, -d ln(1+e)/dt in the mean, > 0
};

/// Parts each loading segment where its height against time bends: the segment is taken as a polygon with as
/// few corners as leave no point further from it than 0.2 % of the height (Douglas & Peucker 1973), corners
/// with less than a quarter of difference in rate left out. Stretches of fewer than 3 points, or that do not
/// compress, are none. The readings of stress-controlled steps (equal stress) belong to no block.
[[nodiscard]] std::vector<RateBlock> rate_blocks(std::span<const CurvePoint> curve);

}  // namespace isotach::calibration
