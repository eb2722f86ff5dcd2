// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Measured outlines of a slump test: the mud's surface in the r-z plane at several times.
#pragma once

#include <filesystem>
#include <vector>

#include "datasets/csv_table.hpp"
#include "datasets/text_file.hpp"

namespace isotach::datasets {

/// A point of the mud's surface.
struct OutlinePoint {
  double r;  ///< distance from the axis (m)
  double z;  ///< height above the base (m)
};

/// The surface at one time.
struct Outline {
  double time;                       ///< s since the mould began to rise, > 0
  std::vector<OutlinePoint> points;  ///< at least 3, in the file's order: from the toe to the axis
};

/// Reads `time_s, r_mm, z_mm`: one row a point, the points of one time together, times increasing.
/// A reading may lie up to 5 mm on the wrong side of the axis or of the base; it is kept as read.
/// InputError: what CsvTable refuses, a missing column, a time that is not positive or steps back, a
/// coordinate below -5 mm, fewer than 3 points at a time.
[[nodiscard]] std::vector<Outline> read_outlines(const std::filesystem::path& file,
                                                 const ReadOptions& options = {});
/// The same of a table in memory.
[[nodiscard]] std::vector<Outline> parse_outlines(const CsvTable& table);

}  // namespace isotach::datasets
