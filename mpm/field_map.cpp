// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/field_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isotach::mpm {

namespace {

constexpr double kFilled = 0.5;  // volume fraction from which a cell is drawn, as the outline's

std::size_t cells_on(double length, double cell_size) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / cell_size * (1.0 - 1e-12))));
}

double map_cell_size(double grid_cell, double width, double height) {
  const double longest = std::max(width, height);
  return grid_cell * static_cast<double>(cells_on(longest, grid_cell * static_cast<double>(kLargestMap)));
}

}  // namespace

FieldSums::FieldSums(double grid_cell, double width, double height)
    : cell_size_(map_cell_size(grid_cell, width, height)),
      columns_(cells_on(width, cell_size_)),
      rows_(cells_on(height, cell_size_)),
      cells_(columns_ * rows_) {}

template <class F>
void FieldSums::share_out(double middle, double side, std::size_t count, F&& f) const {
  const auto index = [&](double x) {
    const double last = static_cast<double>(count - 1);
    return static_cast<std::size_t>(std::clamp(std::floor(x / cell_size_), 0.0, last));
  };
  const double begin = middle - 0.5 * side;
  const double end = middle + 0.5 * side;
  const std::size_t last = index(end);
  double from = begin;
  for (std::size_t k = index(begin); k < last; ++k) {
    const double to = static_cast<double>(k + 1) * cell_size_;
    f(k, (to - from) / side);
    from = to;
  }
  f(last, (end - from) / side);
}

void FieldSums::add(double r, double z, double volume, const PointFields& fields) {
  const double area = volume / r;
  const double side = std::sqrt(area);
  share_out(z, side, rows_, [&](std::size_t row, double share_z) {
    share_out(r, side, columns_, [&](std::size_t column, double share_r) {
      Cell& cell = cells_[row * columns_ + column];
      const double share = share_r * share_z;
      const double weight = share * volume;
      cell.volume += weight;
      cell.area += share * area;
      cell.strain_rate_norm += weight * fields.strain_rate_norm;
      cell.overconsolidation_ratio += weight * fields.overconsolidation_ratio;
      cell.pore_pressure += weight * fields.pore_pressure;
    });
  });
}

FieldMap FieldSums::map() const {
  FieldMap map;
  map.cell_size = cell_size_;
  map.columns = columns_;
  map.rows = rows_;
  const auto averages = [this](double Cell::*moment) {
    std::vector<float> values;
    values.reserve(cells_.size());
    for (const Cell& cell : cells_) {
      const bool filled = cell.area >= kFilled * cell_size_ * cell_size_;
      values.push_back(filled ? static_cast<float>(cell.*moment / cell.volume)
                              : std::numeric_limits<float>::quiet_NaN());
    }
    return values;
  };
  map.strain_rate_norm = averages(&Cell::strain_rate_norm);
  map.overconsolidation_ratio = averages(&Cell::overconsolidation_ratio);
  map.pore_pressure = averages(&Cell::pore_pressure);
  return map;
}

std::vector<double> frame_times(double end, std::size_t count) {
  std::vector<double> times;
  const double whole = std::log1p(end / kFrameTimeScale);
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count - 1);
    times.push_back(kFrameTimeScale * std::expm1(part * whole));
  }
  if (count > 0) times.push_back(end);
  return times;
}

}  // namespace isotach::mpm
