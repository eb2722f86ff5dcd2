// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/rate_blocks.hpp"

#include <cmath>

namespace isotach::calibration {

namespace {

constexpr double kBend = 0.002;     // of the height
constexpr double kSameRate = 1.25;  // ratio
constexpr std::size_t kFewest = 3;

double height(const CurvePoint& point) {
  return 1.0 + point.void_ratio;
}

/// Corners of the polygon through points first .. last, both included, in order; `last` is not added.
void add_corners(std::span<const CurvePoint> curve, std::size_t first, std::size_t last,
                 std::vector<std::size_t>& corners) {
  const double slope = (height(curve[last]) - height(curve[first])) / (curve[last].time - curve[first].time);
  double furthest = kBend * height(curve[first]);
  std::size_t corner = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double on_chord = height(curve[first]) + slope * (curve[i].time - curve[first].time);
    const double distance = std::abs(height(curve[i]) - on_chord);
    if (distance > furthest) {
      furthest = distance;
      corner = i;
    }
  }
  if (corner == first) {
    corners.push_back(first);
    return;
  }
  add_corners(curve, first, corner, corners);
  add_corners(curve, corner, last, corners);
}

double rate_between(const CurvePoint& first, const CurvePoint& last) {
  return std::log(height(first) / height(last)) / (last.time - first.time);
}

}  // namespace

std::vector<RateBlock> rate_blocks(std::span<const CurvePoint> curve) {
  std::vector<RateBlock> blocks;
  for (std::size_t begin = 0; begin < curve.size();) {
    std::size_t end = begin + 1;
    while (end < curve.size() && curve[end].segment == curve[begin].segment) ++end;
    if (curve[begin].stage == datasets::Stage::load && end - begin >= kFewest &&
        !stepwise(curve.subspan(begin, end - begin))) {
      std::vector<std::size_t> corners;
      add_corners(curve, begin, end - 1, corners);
      corners.push_back(end - 1);
      for (std::size_t k = 1; k + 1 < corners.size();) {
        const double before = rate_between(curve[corners[k - 1]], curve[corners[k]]);
        const double after = rate_between(curve[corners[k]], curve[corners[k + 1]]);
        if (after > before / kSameRate && after < before * kSameRate) {
          corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(k));
        } else {
          ++k;
        }
      }
      for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
        const double rate = rate_between(curve[corners[k]], curve[corners[k + 1]]);
        const std::size_t count = corners[k + 1] - corners[k] + 1;
        if (rate > 0.0 && count >= kFewest) blocks.push_back({corners[k], count, rate});
      }
    }
    begin = end;
  }
  return blocks;
}

}  // namespace isotach::calibration
