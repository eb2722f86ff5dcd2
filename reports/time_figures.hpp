// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What happened with time: creep under each load or hold, and relaxation.
#pragma once

#include <vector>

#include "reports/figure.hpp"
#include "reports/oedometer_view.hpp"

namespace isotach::reports {

/// Fewest readings of a stretch that are drawn against time.
inline constexpr std::size_t kFewestReadings = 3;

/// In the order of the test: axial strain against the logarithm of time since the load of each load step;
/// strain since its beginning of each hold of stress; stress of each relaxation. Stretches of fewer than
/// kFewestReadings readings have none.
[[nodiscard]] std::vector<Figure> time_figures(const TestView& view);

}  // namespace isotach::reports
