// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a result tends to as cells shrink, where it need not do so at one order or from one side.
#pragma once

#include <span>

namespace isotach::bench {

/// A limit and how far it may be off; both in the unit of the values.
struct CellLimit {
  double value;
  double uncertainty;  ///< >= 0
};

/// Limit at cell size zero of values at the cell sizes (any unit, > 0, at least three, all different).
/// Richardson's formula wants one order and errors of one sign; outlines of mud that softens scatter with the
/// grid by as much as they tend anywhere, and two or three values would extrapolate the scatter. So lines in
/// h and in h^2 are fitted by least squares; the limit is the mean of where they meet h = 0, the uncertainty
/// the largest distance from there to either and to any of the values.
[[nodiscard]] CellLimit cell_limit(std::span<const double> cells, std::span<const double> values);

}  // namespace isotach::bench
