// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where simulated outlines and measured ones differ.
#pragma once

#include <vector>

#include "discovery/slump_discovery.hpp"

namespace isotach::discovery {

/// By test, zone and time, ranked; `simulations` are of all `tests`, without outlines where a test has
/// none.
[[nodiscard]] std::vector<SlumpDisagreement> slump_disagreement(
    const SlumpTests& tests, const std::vector<mpm::SlumpResult>& simulations);

/// Root mean square of decorrelated residuals of the fitted tests that is left where each point's distance is
/// reduced by the mean of its neighbours' on the same outline: what a curve drawn through the points would
/// reach.
[[nodiscard]] double smoothed_outline_gap(const SlumpTests& tests,
                                          const std::vector<mpm::SlumpResult>& simulations);

}  // namespace isotach::discovery
