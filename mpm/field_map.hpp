// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a body looks like at one instant: averages over square cells of the meridian plane, for pictures.
#pragma once

#include <cstddef>
#include <vector>

#include "mpm/outline.hpp"

namespace isotach::mpm {

/// What a map shows of a material point.
struct PointFields {
  double strain_rate_norm;         ///< |D| (1/s)
  double overconsolidation_ratio;  ///< OCR (-)
  double pore_pressure;            ///< u (Pa), compression positive
};

/// Averages over the square cells of a lattice that begins at axis and base, row by row upwards, in each row
/// from the axis outwards. Cells that the mud fills by less than half are NaN.
struct FieldMap {
  double cell_size = 0.0;  ///< m
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> strain_rate_norm;         ///< |D| (1/s)
  std::vector<float> overconsolidation_ratio;  ///< OCR (-)
  std::vector<float> pore_pressure;            ///< u (Pa), compression positive

  template <class Archive>
  void visit(Archive& archive) {
    archive(cell_size);
    archive(columns);
    archive(rows);
    archive(strain_rate_norm);
    archive(overconsolidation_ratio);
    archive(pore_pressure);
  }
};

/// A map, and what is drawn around it.
struct Frame {
  double time = 0.0;  ///< s
  double rim = 0.0;   ///< m, height of the mould's rim
  FieldMap fields;
  Outline outline{};

  template <class Archive>
  void visit(Archive& archive) {
    archive(time);
    archive(rim);
    archive(fields);
    archive(outline);
  }
};

/// No map has more columns or rows.
inline constexpr std::size_t kLargestMap = 200;

/// Sums over points from which a map is made: as large as the lattice, whatever the number of points.
///
/// A point is a square as large as its share of the meridian plane, V/r, and counts for the cells that the
/// square lies on by what lies on each, so that the volume is shared out and nothing of it is lost; what
/// would stick out beyond axis or base, or beyond the far sides, counts for the cell within.
class FieldSums {
 public:
  /// For points between axis and `width`, base and `height` (m, > 0); cells of the size `grid_cell` (m), or
  /// of the least multiple of it with which the map is no larger than kLargestMap.
  FieldSums(double grid_cell, double width, double height);

  /// A point at (r, z) (m) of the volume V (m3/rad).
  void add(double r, double z, double volume, const PointFields& fields);

  [[nodiscard]] double cell_size() const { return cell_size_; }
  /// Volume shared out to a cell so far (m3/rad).
  [[nodiscard]] double volume(std::size_t column, std::size_t row) const {
    return cells_[row * columns_ + column].volume;
  }
  [[nodiscard]] FieldMap map() const;

 private:
  struct Cell {
    double volume = 0.0;            // m3/rad
    double area = 0.0;              // m2
    double strain_rate_norm = 0.0;  // these times volume
    double overconsolidation_ratio = 0.0;
    double pore_pressure = 0.0;
  };
  /// The part of [middle - side/2, middle + side/2] that lies on each cell of a line of `count`.
  template <class F>
  void share_out(double middle, double side, std::size_t count, F&& f) const;

  double cell_size_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<Cell> cells_;
};

/// Times of `count` frames of a run that ends at `end` (s): even steps of ln(1 + t/kFrameTimeScale) from the
/// start to the end, so that the frames are dense early, when a slump is fast: half of them within the first
/// 1.2 s of 30 s. One frame is that of the end.
[[nodiscard]] std::vector<double> frame_times(double end, std::size_t count);

inline constexpr double kFrameTimeScale = 0.05;  // s

}  // namespace isotach::mpm
