// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mud that comes down on a base: the space between the two.
#pragma once

#include "mpm/grid.hpp"
#include "mpm/transfer.hpp"

namespace isotach::mpm {

/// The base (z = 0) holds nodes that reach a cell and a half above it, so mud that comes down is slowed and
/// compressed before it is there, and would stay above a gap of some tenth of a cell, pressed against
/// nothing. The share of space that points fill tells: where they fill less of it at a corner on the base
/// than at the one above, compression there closes the gap and does not compress the mud. To be called once
/// the field's mean holds tr D; does nothing where mud fills the space.
void close_gap_above_base(const Grid& grid, Symmetry symmetry, CornerField& field);

}  // namespace isotach::mpm
