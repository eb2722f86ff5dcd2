// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The distance between a measured point of a slump's surface and a simulated outline.
#pragma once

#include <span>

#include "mpm/outline.hpp"

namespace isotach::experiments {

/// Shortest distance (m) from the point to the polyline, positive where the polyline, which runs from the toe
/// to the axis, has the point on its left: the simulated mud then reaches beyond the measured surface.
[[nodiscard]] double signed_distance(const mpm::OutlinePoint& point,
                                     std::span<const mpm::OutlinePoint> polyline);

}  // namespace isotach::experiments
