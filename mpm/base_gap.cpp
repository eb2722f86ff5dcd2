// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/base_gap.hpp"

#include <algorithm>

namespace isotach::mpm {

namespace {

// A gap of this share of the space takes all of the compression, a smaller one its part: volumes in the mud
// differ by some parts in a thousand from what they were, and by a few in a hundred from cell to cell.
constexpr double kWholeGap = 0.1;

}  // namespace

void close_gap_above_base(const Grid& grid, Symmetry symmetry, CornerField& field) {
  const double h = grid.cell_size();
  const CornerSum* sums = field.pressures.data();
  for (std::size_t i = 0; i < field.pressures.end(0); ++i) {
    double& rate = field.mean[grid.index(i, 0)];
    if (rate >= 0.0) continue;
    // of a corner's space above the base; the one on the axis reaches to one side only
    const double width = i == 0 ? 0.5 * h : h;
    const double radius = i == 0 ? h / 3.0 : static_cast<double>(i) * h;
    const double space = width * 0.5 * h * (symmetry == Symmetry::axisymmetric ? radius : 1.0);
    const double filled = sums[grid.index(i, 0)].volume / space;
    const double above = std::min(1.0, sums[grid.index(i, 1)].volume / (2.0 * space));
    rate *= 1.0 - std::clamp((above - filled) / kWholeGap, 0.0, 1.0);
  }
}

}  // namespace isotach::mpm
