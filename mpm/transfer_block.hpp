// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the passes over points share: a block's points in their cells, and stretches of points in the same
// cell.
#pragma once

#include <algorithm>
#include <cstring>

#include "mpm/cell_place.hpp"
#include "mpm/transfer.hpp"

namespace isotach::mpm {

using Column = double[kBlock];

/// Cells of a block's points.
struct BlockCells {
  alignas(64) long long cell[kBlock];
  alignas(64) long long row[kBlock];

  [[gnu::always_inline]] void store(std::size_t p, const CellPlace& place) {
    std::memcpy(cell + p, &place.cell, sizeof place.cell);
    std::memcpy(row + p, &place.row, sizeof place.row);
  }
};

/// Stretches of points in the same cell: open(cell), each(point) for its points, close(cell, row). Points
/// that are sorted by cells make few stretches; what is shared by a cell is then fetched and stored once for
/// all of them.
template <class Open, class Each, class Close>
[[gnu::always_inline]] inline void for_cells(const BlockCells& cells, std::size_t count, Open&& open,
                                             Each&& each, Close&& close) {
  std::size_t p = 0;
  while (p < count) {
    const long long cell = cells.cell[p];
    const long long row = cells.row[p];
    open(static_cast<std::size_t>(cell));
    do {
      each(p);
      ++p;
    } while (p < count && cells.cell[p] == cell);
    close(static_cast<std::size_t>(cell), static_cast<std::size_t>(row));
  }
}

/// Values of a corner field at the four corners of each point's cell.
struct CornerValues {
  alignas(64) Column c00, c10, c01, c11;

  void fetch(const BlockCells& cells, std::size_t count, const double* values, std::size_t stride) {
    for (std::size_t p = 0; p < count; ++p) {
      const double* v = values + cells.cell[p];
      c00[p] = v[0];
      c10[p] = v[1];
      c01[p] = v[stride];
      c11[p] = v[stride + 1];
    }
  }
  [[nodiscard, gnu::always_inline]] Octet at(std::size_t p, const CornerOctets& w) const {
    return w.w00 * load_octet(c00 + p) + w.w10 * load_octet(c10 + p) + w.w01 * load_octet(c01 + p) +
           w.w11 * load_octet(c11 + p);
  }
};

/// Parts of an amount for the four corners of each point's cell.
struct CornerParts {
  alignas(64) Column c00, c10, c01, c11;

  [[gnu::always_inline]] void store(std::size_t p, const CornerOctets& w, const Octet& amount) {
    store_octet(c00 + p, w.w00 * amount);
    store_octet(c10 + p, w.w10 * amount);
    store_octet(c01 + p, w.w01 * amount);
    store_octet(c11 + p, w.w11 * amount);
  }
};

[[nodiscard]] inline std::size_t padded_to_octets(std::size_t count) {
  return (count + kOctet - 1) / kOctet * kOctet;
}

/// Notes the nodes (or corners) that cells touch, `size` by `size` each. Neighbours follow each other, so
/// rows are widened once for a stretch of cells.
template <class T>
class Extent {
 public:
  Extent(RowSums<T>& sums, std::size_t size) : sums_(sums), size_(size) {}
  ~Extent() { flush(); }
  Extent(const Extent&) = delete;
  Extent& operator=(const Extent&) = delete;

  [[gnu::always_inline]] void touch(std::size_t cell, std::size_t row) {
    const std::size_t end = cell - row * sums_.stride() + size_;
    if (row != row_) {
      flush();
      row_ = row;
      end_ = 0;
    }
    end_ = std::max(end_, end);
  }

 private:
  void flush() {
    for (std::size_t j = 0; j < size_ && end_ > 0; ++j) sums_.touch(row_ + j, end_);
  }

  RowSums<T>& sums_;
  std::size_t size_;
  std::size_t row_ = 0;
  std::size_t end_ = 0;
};

template <Symmetry S>
[[gnu::always_inline]] inline Octet hoop_rate(const Octet& velocity_r, const Octet& r) {
  return S == Symmetry::axisymmetric ? velocity_r / r : Octet{};
}

}  // namespace isotach::mpm
