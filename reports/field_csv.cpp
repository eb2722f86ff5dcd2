// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/field_csv.hpp"

#include <array>
#include <cmath>

#include "reports/units.hpp"

namespace isotach::reports {

void write_fields(OutputDirectory& output, const std::vector<mpm::Frame>& frames) {
  std::array<std::vector<double>, 6> columns;
  for (const mpm::Frame& frame : frames) {
    const mpm::FieldMap& map = frame.fields;
    for (std::size_t cell = 0; cell < map.columns * map.rows; ++cell) {
      if (std::isnan(map.strain_rate_norm[cell])) continue;
      const double column = static_cast<double>(cell % map.columns);
      const double row = static_cast<double>(cell / map.columns);
      columns[0].push_back(frame.time);
      columns[1].push_back(kMillimetres * map.cell_size * (column + 0.5));
      columns[2].push_back(kMillimetres * map.cell_size * (row + 0.5));
      columns[3].push_back(static_cast<double>(map.strain_rate_norm[cell]));
      columns[4].push_back(static_cast<double>(map.overconsolidation_ratio[cell]));
      columns[5].push_back(1e-3 * static_cast<double>(map.pore_pressure[cell]));
    }
  }
  output.write_csv("fields.csv", std::array<CsvColumn, 6>{{{"time_s", std::move(columns[0])},
                                                           {"r_mm", std::move(columns[1])},
                                                           {"z_mm", std::move(columns[2])},
                                                           {"strain_rate_per_s", std::move(columns[3])},
                                                           {"ocr", std::move(columns[4])},
                                                           {"pore_pressure_kPa", std::move(columns[5])}}});
}

}  // namespace isotach::reports
