// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slump that moves: one SVG without scripts.
#pragma once

#include <span>

#include "mpm/slump_setup.hpp"
#include "reports/field_canvas.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// The quantity through time with outline and mould, the time, and a bar of what has passed, again and again:
/// every frame is a group that SMIL shows for its turn. Frames are shown for equal times, the last one
/// longer, so that time is compressed as they are (mpm::frame_times). Where nothing moves, and on
/// paper, the last frame stands. Throws std::invalid_argument without frames.
[[nodiscard]] Drawing field_animation(FieldQuantity quantity, std::span<const mpm::Frame> frames,
                                      const mpm::Mould& mould);

/// Length of a loop, and how long the last frame stands in it (s).
inline constexpr double kLoop = 8.0;
inline constexpr double kLastFrame = 1.0;

}  // namespace isotach::reports
