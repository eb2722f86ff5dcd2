// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where points lie in their cells, for eight points at once: the cell and the weights of its nodes and
// corners.
#pragma once

#include "mpm/octet.hpp"

namespace isotach::mpm {

/// A point's cell and its place in it, in cells: 0 <= x, y < 1 from the corner nearest to the origin.
struct CellPlace {
  IntegerOctet cell;  ///< index of the corner, of the first of the cell's 3 x 3 nodes too
  IntegerOctet row;   ///< of cells
  Octet x, y;
};

[[nodiscard, gnu::always_inline]] inline CellPlace cell_place(const Octet& r, const Octet& z,
                                                              double inverse_h, std::size_t stride) {
  const Octet u = r * inverse_h;
  const Octet v = z * inverse_h;
  const IntegerOctet i = truncated(u);
  const IntegerOctet j = truncated(v);
  return {i + j * static_cast<long long>(stride), j, u - to_double(i), v - to_double(j)};
}

/// Weights of the quadratic B-splines of three nodes at the centres of the cell and its neighbours: sum 1,
/// first moment of node - point 0, second moment 1/4.
struct SplineOctets {
  Octet weight[3];

  [[gnu::always_inline]] explicit SplineOctets(const Octet& x)
      : weight{0.5 * (1.0 - x) * (1.0 - x), 0.75 - (x - 0.5) * (x - 0.5), 0.5 * x * x} {}
};

/// Bilinear weights of the four corners.
struct CornerOctets {
  Octet w00, w10, w01, w11;

  [[gnu::always_inline]] explicit CornerOctets(const CellPlace& p)
      : w00((1.0 - p.x) * (1.0 - p.y)), w10(p.x * (1.0 - p.y)), w01((1.0 - p.x) * p.y), w11(p.x * p.y) {}
};

}  // namespace isotach::mpm
