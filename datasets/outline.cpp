// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Measured outlines of a slump test: implementation.
#include "datasets/outline.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace isotach::datasets {
namespace {

/// Noise of reading is of the order of 1 mm; a coordinate further out is a mistake of sign or origin.
constexpr Range kCoordinate_mm{-5.0};

}  // namespace

std::vector<Outline> read_outlines(const std::filesystem::path& file, const ReadOptions& options) {
  return parse_outlines(CsvTable::read(file, options));
}

std::vector<Outline> parse_outlines(const CsvTable& table) {
  const std::size_t time_column = table.require("time_s");
  const std::size_t r_column = table.require("r_mm");
  const std::size_t z_column = table.require("z_mm");

  std::vector<Outline> outlines;
  const auto check_last = [&](std::size_t row) {
    const Outline& last = outlines.back();
    if (last.points.size() >= 3) return;
    throw InputError(table.place(row), fmt::format("outline at {} s", last.time),
                     fmt::format("{} points", last.points.size()), "at least 3 points at each time");
  };
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const double time = table.number(row, time_column, Range::positive());
    if (outlines.empty() || time > outlines.back().time) {
      if (!outlines.empty()) check_last(row - 1);
      outlines.push_back({time, {}});
    } else if (time < outlines.back().time) {
      throw InputError(table.place(row), "column time_s",
                       fmt::format("{} after {}", time, outlines.back().time), "times that do not decrease");
    }
    outlines.back().points.push_back({1e-3 * table.number(row, r_column, kCoordinate_mm),
                                      1e-3 * table.number(row, z_column, kCoordinate_mm)});
  }
  check_last(table.row_count() - 1);
  return outlines;
}

}  // namespace isotach::datasets
