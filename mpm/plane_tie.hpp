// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Two grids, one on top of the other, made to stick where they meet.
#pragma once

#include <cstddef>
#include <optional>

#include "mpm/grid.hpp"

namespace isotach::mpm {

/// Makes the bottom of a grid and the top of the one below it move as one. Each side is open, and the plane
/// between lies halfway between two rows of nodes: its velocity is the mean of the two rows', on either side,
/// all along it, as the splines are the same. Equal and opposite momenta and forces, half on each row, make
/// the two means equal, before the step and after it. So nothing sticks to what is a cell away, and each side
/// may shear up to the plane: over what does not move at all the result is that of Grid's fixed side, to
/// round-off. The forces do no work together. They are counted as applied ones.
///
/// The sums hold what the points gave, folded in the sides that are not open. Places are those of the grids:
/// what lies against the plane must not move far beyond it, against the size of a cell.
///
/// Returns the first column where there is something above the plane and nothing below it; the sums are then
/// of no use.
[[nodiscard]] std::optional<std::size_t> tie_planes(NodeSums& above, NodeSums& below);

}  // namespace isotach::mpm
