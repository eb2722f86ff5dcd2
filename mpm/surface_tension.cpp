// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/surface_tension.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace isotach::mpm {

namespace {

/// Quadratic B-splines of a cell's three nodes along one direction, and their slopes (1/cell).
struct Spline {
  std::size_t first;
  std::array<double, 3> weight;
  std::array<double, 3> slope;

  explicit Spline(double cells) : first(static_cast<std::size_t>(cells)) {
    const double x = cells - static_cast<double>(first);
    weight = {0.5 * (1.0 - x) * (1.0 - x), 0.75 - (x - 0.5) * (x - 0.5), 0.5 * x * x};
    slope = {x - 1.0, 1.0 - 2.0 * x, x};
  }
};

}  // namespace

SurfaceTension::SurfaceTension(double tension, const Grid& grid)
    : tension_(tension),
      h_(grid.cell_size()),
      columns_(grid.stride()),
      rows_(grid.rows() + 2),
      on_base_(grid.sides().bottom != Side::open),
      share_(columns_ * rows_) {}

void SurfaceTension::fill(const Particles& q) {
  std::fill(share_.begin(), share_.end(), 0.0);
  for (std::size_t p = 0; p < q.count; ++p) {
    const Spline r(q.r[p] / h_);
    const Spline z(q.z[p] / h_);
    const double volume = q.volume(p);
    for (std::size_t b = 0; b < 3; ++b) {
      double* row = &share_[(z.first + b) * columns_ + r.first];
      for (std::size_t a = 0; a < 3; ++a) row[a] += volume * z.weight[b] * r.weight[a];
    }
  }
  for (std::size_t j = 0; j < rows_; ++j) share_[j * columns_ + 1] += share_[j * columns_];
  if (on_base_) {
    for (std::size_t i = 1; i < columns_; ++i) share_[columns_ + i] += share_[i];
  }
  for (std::size_t j = 0; j < rows_; ++j) {
    for (std::size_t i = 1; i < columns_; ++i) {
      share_[j * columns_ + i] /= (static_cast<double>(i) - 0.5) * h_ * h_ * h_;
    }
  }
  if (on_base_) {
    for (std::size_t i = 1; i < columns_; ++i) share_[i] = share_[columns_ + i];
  }
  for (std::size_t j = 0; j < rows_; ++j) share_[j * columns_] = share_[j * columns_ + 1];
}

void SurfaceTension::prepare(Particles& q) {
  fill(q);
  for (std::size_t p = 0; p < q.count; ++p) {
    const Spline r(q.r[p] / h_);
    const Spline z(q.z[p] / h_);
    double along_r = 0.0;
    double along_z = 0.0;
    for (std::size_t b = 0; b < 3; ++b) {
      const double* row = &share_[(z.first + b) * columns_ + r.first];
      for (std::size_t a = 0; a < 3; ++a) {
        along_r += row[a] * r.slope[a] * z.weight[b];
        along_z += row[a] * r.weight[a] * z.slope[b];
      }
    }
    const double gradient = std::hypot(along_r, along_z);  // over a cell
    const double strength = 2.0 * tension_ / h_ * gradient;
    if (gradient < kFaint) {
      for (auto& component : q.capillary) component[p] = 0.0;
      continue;
    }
    const double n_r = along_r / gradient;
    const double n_z = along_z / gradient;
    q.capillary[0][p] = strength * (1.0 - n_r * n_r);
    q.capillary[1][p] = strength * (1.0 - n_z * n_z);
    q.capillary[2][p] = strength;
    q.capillary[3][p] = -strength * n_r * n_z * std::numbers::sqrt2;
  }
}

}  // namespace isotach::mpm
