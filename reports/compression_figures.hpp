// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Compression curves in the engineer's axes, with isotachs behind them.
#pragma once

#include <span>

#include "reports/figure.hpp"
#include "reports/oedometer_view.hpp"

namespace isotach::reports {

/// Void ratio against log axial effective stress: measured, model, isotachs.
[[nodiscard]] Figure void_ratio_figure(const TestView& view);
/// Axial strain, increasing downwards, against log axial effective stress: the same.
[[nodiscard]] Figure strain_figure(const TestView& view);
/// Void ratio against log stress of all tests, without isotachs.
[[nodiscard]] Figure overview_figure(std::span<const TestView> views);

}  // namespace isotach::reports
