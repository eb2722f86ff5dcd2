// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The order of a body's points: those of a cell side by side, cells in rows.
#pragma once

#include "mpm/grid.hpp"
#include "mpm/particles.hpp"

namespace isotach::mpm {

/// Stretches of points that follow each other in the same cell; one a cell where points are sorted.
[[nodiscard]] std::size_t count_stretches(const Grid& grid, const Particles& points);

/// Sorts the points, which must lie on the grid, by cells; those of a cell keep their order.
void sort_by_cells(const Grid& grid, Particles& points);

}  // namespace isotach::mpm
