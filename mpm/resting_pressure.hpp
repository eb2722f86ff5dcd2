// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Pressures of points whose average over cells is that of a liquid at rest.
#pragma once

#include <vector>

namespace isotach::mpm {

/// Total pressures (Pa) of rows of points of equal volume at `heights` (m, increasing, > 0) such that their
/// averages at the corners of cells are unit_weight (N/m3) times the depth below `surface` (m), above the
/// surface and at the base too. Averages there are one-sided: of pressures that are hydrostatic themselves
/// they would be a third of unit_weight h off, and the fill would start with a jolt. Of all such pressures,
/// those nearest to the hydrostatic ones. There must be two rows a cell or more.
[[nodiscard]] std::vector<double> resting_pressures(const std::vector<double>& heights, double cell_size,
                                                    double unit_weight, double surface);

}  // namespace isotach::mpm
