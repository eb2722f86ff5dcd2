// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/outline_distance.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::experiments {

double signed_distance(const mpm::OutlinePoint& point, std::span<const mpm::OutlinePoint> polyline) {
  double best2 = HUGE_VAL;
  double side_of_best = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const double ur = polyline[i].r - polyline[i - 1].r;
    const double uz = polyline[i].z - polyline[i - 1].z;
    const double wr = point.r - polyline[i - 1].r;
    const double wz = point.z - polyline[i - 1].z;
    const double length2 = ur * ur + uz * uz;
    if (length2 == 0.0) continue;
    const double along = std::clamp((wr * ur + wz * uz) / length2, 0.0, 1.0);
    const double dr = wr - along * ur;
    const double dz = wz - along * uz;
    const double distance2 = dr * dr + dz * dz;
    const double side = (ur * wz - uz * wr) / std::sqrt(length2);
    // at a corner two segments are equally near: the one that sees the point more squarely knows its side
    const bool nearer = distance2 < best2 * (1.0 - 1e-12);
    const bool tie = !nearer && distance2 <= best2 * (1.0 + 1e-12);
    if (nearer || (tie && std::abs(side) > std::abs(side_of_best))) {
      best2 = std::min(best2, distance2);
      side_of_best = side;
    }
  }
  return std::copysign(std::sqrt(best2), side_of_best);
}

}  // namespace isotach::experiments
