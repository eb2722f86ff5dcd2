// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fields of a slump as numbers.
#pragma once

#include <vector>

#include "mpm/field_map.hpp"
#include "reports/output_directory.hpp"

namespace isotach::reports {

/// fields.csv, what the report's maps draw: time_s, r_mm, z_mm (middle of a cell), strain_rate_per_s, ocr,
/// pore_pressure_kPa; a row for each cell that is not empty, frame by frame.
void write_fields(OutputDirectory& output, const std::vector<mpm::Frame>& frames);

}  // namespace isotach::reports
