// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The background grid: nodes at the centres of square cells, mirrored in the axis and in the base.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isotach::mpm {

/// Eight doubles that are added and scaled as one: all that a point gives to a node in one operation.
using Octet = double __attribute__((vector_size(64)));
/// Velocity of a node after the step (r, z), and its change in the step (r, z); m/s.
using NodeVelocity = double __attribute__((vector_size(32)));

/// Places in a node's Octet. Per radian.
enum NodeEntry { kMass, kMomentumR, kMomentumZ, kInternalR, kInternalZ, kContactR, kContactZ, kGravityZ };

/// Nodes at ((i - 1/2) h, (j - 1/2) h), i, j = 0, 1, ...; the row i = 0 and the line j = 0 are the mirror
/// images of i = 1 and j = 1 in the axis r = 0 and in the base z = 0. A field on this grid that is odd in the
/// mirror vanishes exactly on it: v_r on the axis; v_r and v_z on a base without slip.
class Grid {
 public:
  /// A grid of at least `radius` by `height` (m).
  Grid(double cell_size, double radius, double height)
      : h_(cell_size),
        columns_(static_cast<int>(std::ceil(radius / cell_size)) + 3),
        rows_(static_cast<int>(std::ceil(height / cell_size)) + 3),
        nodes_(static_cast<std::size_t>(columns_ * rows_)),
        velocities_(nodes_.size()),
        corner_values_(nodes_.size()),
        corner_volumes_(nodes_.size()) {}

  [[nodiscard]] double cell_size() const { return h_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// Largest r and z (m) a point may have and still find all its nodes.
  [[nodiscard]] double largest_r() const { return (columns_ - 3) * h_; }
  [[nodiscard]] double largest_z() const { return (rows_ - 3) * h_; }

  [[nodiscard]] std::size_t index(int i, int j) const { return static_cast<std::size_t>(j * columns_ + i); }

  [[nodiscard]] Octet* nodes() { return nodes_.data(); }
  [[nodiscard]] NodeVelocity* velocities() { return velocities_.data(); }
  [[nodiscard]] const NodeVelocity* velocities() const { return velocities_.data(); }
  /// Values at the cell corners (i h, j h), index(i, j): bilinear averages of point values.
  [[nodiscard]] double* corner_values() { return corner_values_.data(); }
  [[nodiscard]] const double* corner_values() const { return corner_values_.data(); }
  [[nodiscard]] double* corner_volumes() { return corner_volumes_.data(); }

  /// Nodes in use: columns 0 .. used_columns - 1 and rows 0 .. used_rows - 1.
  void set_used(int columns, int rows) {
    used_columns_ = std::min(columns, columns_);
    used_rows_ = std::min(rows, rows_);
  }
  [[nodiscard]] int used_columns() const { return used_columns_; }
  [[nodiscard]] int used_rows() const { return used_rows_; }

  void clear_nodes() {
    for (int j = 0; j < used_rows_; ++j) {
      std::fill_n(nodes_.begin() + static_cast<std::ptrdiff_t>(index(0, j)), used_columns_, Octet{});
    }
  }
  void clear_corner_values() {
    for (int j = 0; j < used_rows_; ++j) {
      std::fill_n(corner_values_.begin() + static_cast<std::ptrdiff_t>(index(0, j)), used_columns_, 0.0);
    }
  }
  void clear_corner_volumes() {
    for (int j = 0; j < used_rows_; ++j) {
      std::fill_n(corner_volumes_.begin() + static_cast<std::ptrdiff_t>(index(0, j)), used_columns_, 0.0);
    }
  }

  /// Adds what was given to the mirror images to their originals: masses even, the others with the sign of
  /// the velocity component they belong to.
  void fold_mirrors() {
    const Octet axis{1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, 1.0};
    const Octet base{1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0};
    for (int j = 0; j < used_rows_; ++j) nodes_[index(1, j)] += axis * nodes_[index(0, j)];
    for (int i = 0; i < used_columns_; ++i) nodes_[index(i, 1)] += base * nodes_[index(i, 0)];
  }

  /// Gives the mirror images the velocities of their originals.
  void mirror_velocities() {
    for (int j = 1; j < used_rows_; ++j)
      velocities_[index(0, j)] = NodeVelocity{-1.0, 1.0, -1.0, 1.0} * velocities_[index(1, j)];
    for (int i = 0; i < used_columns_; ++i) velocities_[index(i, 0)] = -velocities_[index(i, 1)];
  }

 private:
  double h_;
  int columns_;
  int rows_;
  int used_columns_ = 0;
  int used_rows_ = 0;
  std::vector<Octet> nodes_;
  std::vector<NodeVelocity> velocities_;
  std::vector<double> corner_values_;
  std::vector<double> corner_volumes_;
};

}  // namespace isotach::mpm
