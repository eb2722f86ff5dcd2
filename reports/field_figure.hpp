// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A quantity in the meridian plane at some instants, side by side.
#pragma once

#include <span>
#include <string>

#include "mpm/slump_setup.hpp"
#include "reports/field_canvas.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// A panel for each frame, at most three in a row, with axes, scale and colours in common: the averages over
/// cells as squares, empty where the mud fills less than half of one; the outline; the wall of the mould
/// above its rim. Throws std::invalid_argument without frames.
[[nodiscard]] Drawing field_figure(FieldQuantity quantity, std::span<const mpm::Frame> frames,
                                   const mpm::Mould& mould);

/// The limits of the colours in a sentence.
[[nodiscard]] std::string limits_text(FieldQuantity quantity, const ColourScale& colours);

}  // namespace isotach::reports
