// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where simulated outlines and measured ones differ.
#pragma once

#include <array>
#include <vector>

#include "discovery/slump_discovery.hpp"

namespace isotach::discovery {

/// By test, zone and time, ranked; `simulations` are of all `tests`, without outlines where a test has
/// none.
[[nodiscard]] std::vector<SlumpDisagreement> slump_disagreement(
    const SlumpTests& tests, const std::vector<mpm::SlumpResult>& simulations);

[[nodiscard]] Zone zone_of(const experiments::OutlineStation& station);

/// Roots of the sums of squares over each outline's toe, flank and top, of values that each station has.
[[nodiscard]] std::vector<std::array<double, 3>> roots_by_zone(const experiments::SlumpExperiment& test,
                                                               const experiments::Values& of_stations);

/// Ranks the places of fitted tests by what the explanation's simulations have there and the base's have not,
/// before those of tests held out. Both are fitted, so that it is what the base's parameters do not take up.
void rank_by_explanation(const SlumpTests& tests, const std::vector<mpm::SlumpResult>& base,
                         const std::vector<mpm::SlumpResult>& explanation,
                         std::vector<SlumpDisagreement>& places);

/// Root mean square of decorrelated residuals of the fitted tests that is left where each point's distance is
/// reduced by the mean of its neighbours' on the same outline: what a curve drawn through the points would
/// reach.
[[nodiscard]] double smoothed_outline_gap(const SlumpTests& tests,
                                          const std::vector<mpm::SlumpResult>& simulations);

}  // namespace isotach::discovery
