// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Pressures of points whose average over cells is that of a liquid at rest.
#pragma once

#include <functional>
#include <vector>

namespace isotach::mpm {

/// Total pressures (Pa) of rows of points of equal volume at `heights` (m, increasing, > 0) such that their
/// averages at the corners of cells are `overburden` of the corner's height (m), above the surface and at the
/// base too, where it goes on. Averages there are one-sided: of pressures that are the overburden themselves
/// they would be a third of its change over a cell off, and the fill would start with a jolt. Of all such
/// pressures, those nearest to the overburden. There must be two rows a cell or more.
[[nodiscard]] std::vector<double> resting_pressures(const std::vector<double>& heights, double cell_size,
                                                    const std::function<double(double)>& overburden);

}  // namespace isotach::mpm
