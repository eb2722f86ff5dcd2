// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/point_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace isotach::mpm {

namespace {

using Index = std::uint32_t;  // half the room; Engine::add sees that it suffices

std::size_t cell_of(const Grid& grid, const Particles& q, std::size_t i) {
  const double inverse_h = 1.0 / grid.cell_size();
  return grid.index(static_cast<std::size_t>(q.r[i] * inverse_h),
                    static_cast<std::size_t>(q.z[i] * inverse_h));
}

/// For each place of the order the point that belongs there. What it takes to find out is gone when the
/// arrays are copied, the largest need of memory of a run.
std::vector<Index> sorted_order(const Grid& grid, const Particles& q) {
  std::vector<Index> starts(grid.stride() * (grid.rows() + 2) + 1, 0);
  for (std::size_t i = 0; i < q.count; ++i) ++starts[cell_of(grid, q, i) + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Index> from(q.count);
  for (std::size_t i = 0; i < q.count; ++i) from[starts[cell_of(grid, q, i)]++] = static_cast<Index>(i);
  return from;
}

}  // namespace

std::size_t count_stretches(const Grid& grid, const Particles& q) {
  std::size_t stretches = 0;
  std::size_t last = std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0; i < q.count; ++i) {
    const std::size_t cell = cell_of(grid, q, i);
    stretches += cell != last ? 1U : 0U;
    last = cell;
  }
  return stretches;
}

void sort_by_cells(const Grid& grid, Particles& q) {
  const std::vector<Index> from = sorted_order(grid, q);
  std::vector<double> sorted(q.count);
  q.for_each_array([&](PointArray& array) {
    if (array.empty()) return;
    for (std::size_t i = 0; i < q.count; ++i) sorted[i] = array[from[i]];
    std::copy(sorted.begin(), sorted.end(), array.begin());
  });
}

}  // namespace isotach::mpm
