// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Creep and relaxation stages of an element test, against the logarithm of the time since they began.
#pragma once

#include <vector>

#include "reports/element_figures.hpp"

namespace isotach::reports {

/// For creep the strain since the hold began and its rate, for relaxation the stress; none where no stage
/// holds. Of more holds than a figure can tell apart, some evenly chosen, the last among them.
[[nodiscard]] std::vector<ElementFigure> hold_figures(const datasets::ElementFile& test,
                                                      const ElementCurve& curve);

}  // namespace isotach::reports
