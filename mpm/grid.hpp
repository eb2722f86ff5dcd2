// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The background grid: nodes at the centres of square cells, with a rim of nodes beyond its four sides.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mpm/octet.hpp"
#include "mpm/zeroed_array.hpp"

namespace isotach::mpm {

/// Velocity of a node after the step (r, z), and before it (r, z); m/s.
using NodeVelocity = double __attribute__((vector_size(32)));

/// Places in a node's Octet, per radian: momentum, internal force, mass, applied force, volume. Only the
/// first four vary with the node's place within what one point gives.
inline constexpr std::size_t kMomentumR = 0;
inline constexpr std::size_t kMomentumZ = 1;
inline constexpr std::size_t kInternalR = 2;
inline constexpr std::size_t kInternalZ = 3;
inline constexpr std::size_t kMass = 4;
inline constexpr std::size_t kAppliedR = 5;
inline constexpr std::size_t kAppliedZ = 6;
inline constexpr std::size_t kVolume = 7;
/// Nodes of no more mass (kg/rad) are empty.
inline constexpr double kLeastNodeMass = 1e-30;

/// What holds the material at a side of the grid.
enum class Side {
  open,       ///< nothing; points that pass it have left the grid
  symmetric,  ///< mirror: no velocity across, free along it. Also the axis
  fixed       ///< no velocity at all
};

struct Sides {
  Side left = Side::symmetric;  ///< r = 0
  Side right = Side::open;
  Side bottom = Side::fixed;  ///< z = 0
  Side top = Side::open;
};

/// Sums over the points, at nodes or corners, in rows; only what was touched since the last clear() is
/// cleared and visited.
template <class T>
class RowSums {
 public:
  RowSums(std::size_t stride, std::size_t rows) : stride_(stride), values_(stride * rows), ends_(rows, 0) {}

  [[nodiscard]] T* data() { return values_.data(); }
  [[nodiscard]] const T* data() const { return values_.data(); }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] std::size_t rows() const { return ends_.size(); }
  /// Entries 0 .. end(row) - 1 of a row are in use.
  [[nodiscard]] std::size_t end(std::size_t row) const { return ends_[row]; }

  /// Widens a row to `end` entries.
  void touch(std::size_t row, std::size_t end) { ends_[row] = std::max(ends_[row], end); }
  void clear() {
    for (std::size_t row = 0; row < rows(); ++row) {
      std::fill_n(values_.data() + row * stride_, ends_[row], T{});
      ends_[row] = 0;
    }
  }
  /// Rows as far as they are in use.
  template <class Archive>
  void visit(Archive& archive) {
    if (archive.loading()) clear();
    archive(ends_);
    visit_used(archive, values_.data());
  }
  /// The entries of another array like this one's where this one's are in use.
  template <class Archive, class U>
  void visit_used(Archive& archive, U* values) {
    for (std::size_t row = 0; row < rows(); ++row) archive(values + row * stride_, ends_[row]);
  }
  /// Adds another's sums of the rows first .. last - 1.
  void add(const RowSums& other, std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      touch(row, other.ends_[row]);
      for (std::size_t k = row * stride_; k < row * stride_ + other.ends_[row]; ++k) {
        values_[k] += other.values_[k];
      }
    }
  }

 private:
  std::size_t stride_;
  ZeroedArray<T> values_;
  std::vector<std::size_t> ends_;
};

using NodeSums = RowSums<Octet>;

/// Volume and the volume times a quantity, at the corners of cells.
struct CornerSum {
  double volume;
  double moment;
  CornerSum& operator+=(const CornerSum& other) {
    volume += other.volume;
    moment += other.moment;
    return *this;
  }
};

/// Nodes at ((i - 1/2) h, (j - 1/2) h), i = 0 .. columns() + 1, j = 0 .. rows() + 1; corners of cells at
/// (i h, j h). The outermost nodes are the images of their neighbours in a side that is not open. A field
/// that is odd in the mirror vanishes exactly on it: v_r on the axis; v_r and v_z on a base without slip.
class Grid {
 public:
  /// A grid of at least `width` by `height` (m).
  Grid(double cell_size, double width, double height, const Sides& sides)
      : h_(cell_size),
        columns_(cells(width)),
        rows_(cells(height)),
        sides_(sides),
        sums_(columns_ + 2, rows_ + 2),
        velocities_(stride() * (rows_ + 2)) {}

  [[nodiscard]] double cell_size() const { return h_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }  ///< of cells
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] double width() const { return static_cast<double>(columns_) * h_; }  ///< m
  [[nodiscard]] double height() const { return static_cast<double>(rows_) * h_; }
  [[nodiscard]] const Sides& sides() const { return sides_; }

  [[nodiscard]] std::size_t stride() const { return columns_ + 2; }
  [[nodiscard]] std::size_t index(std::size_t i, std::size_t j) const { return j * stride() + i; }
  [[nodiscard]] NodeSums& sums() { return sums_; }
  [[nodiscard]] const NodeSums& sums() const { return sums_; }
  [[nodiscard]] NodeVelocity* velocities() { return velocities_.data(); }
  [[nodiscard]] const NodeVelocity* velocities() const { return velocities_.data(); }

  /// Adds what was given to the images to their originals: masses even, the others with the sign of the
  /// velocity component they belong to. First those in the left and right side, then those in base and top.
  void fold_columns() { for_columns(Folding{sums_.data()}); }
  void fold_rows() { for_rows(Folding{sums_.data()}); }
  /// Gives the images the velocities of their originals.
  void mirror_velocities() {
    const auto mirror = [this](std::size_t image, std::size_t original, double r, double z) {
      velocities_[image] = NodeVelocity{r, z, r, z} * velocities_[original];
    };
    for_columns(mirror);
    for_rows(mirror);
  }

 private:
  [[nodiscard]] std::size_t cells(double length) const {
    // a length of whole cells, but for round-off, is taken as such
    return static_cast<std::size_t>(std::ceil(length / h_ * (1.0 - 1e-12)));
  }
  struct Folding {
    Octet* sums;
    void operator()(std::size_t image, std::size_t original, double r, double z) const {
      sums[original] += Octet{r, z, r, z, 1.0, r, z, 1.0} * sums[image];
    }
  };
  [[nodiscard]] static double along(Side side) { return side == Side::fixed ? -1.0 : 1.0; }
  /// Calls f(image, original, sign of r components, sign of z components) for the images beyond left and
  /// right.
  template <class F>
  void for_columns(F&& f) {
    for (std::size_t j = 0; j < sums_.rows(); ++j) {
      if (sides_.left != Side::open && sums_.end(j) > 0)
        f(index(0, j), index(1, j), -1.0, along(sides_.left));
      if (sides_.right != Side::open && sums_.end(j) > columns_) {
        f(index(columns_ + 1, j), index(columns_, j), -1.0, along(sides_.right));
      }
    }
  }
  /// The same for those beyond base and top.
  template <class F>
  void for_rows(F&& f) {
    const std::size_t top = rows_ + 1;
    if (sides_.bottom != Side::open) {
      for (std::size_t i = 0; i < sums_.end(0); ++i) f(index(i, 0), index(i, 1), along(sides_.bottom), -1.0);
    }
    if (sides_.top != Side::open) {
      for (std::size_t i = 0; i < sums_.end(top); ++i)
        f(index(i, top), index(i, rows_), along(sides_.top), -1.0);
    }
  }

  double h_;
  std::size_t columns_;
  std::size_t rows_;
  Sides sides_;
  NodeSums sums_;
  ZeroedArray<NodeVelocity> velocities_;
};

}  // namespace isotach::mpm
