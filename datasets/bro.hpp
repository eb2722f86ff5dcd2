// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Incremental-loading oedometer tests in the columns of the Dutch subsurface registry (BRO).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "datasets/csv_table.hpp"
#include "datasets/oedometer.hpp"
#include "datasets/specimen.hpp"

namespace isotach::datasets {

/// Columns that tell the tests of a file apart.
inline constexpr std::array<std::string_view, 2> kBroKeys{"bro_id", "begin_depth_m"};

/// Whether the header is that of such a file: it has a column bro_id.
[[nodiscard]] bool is_bro(const CsvTable& table);

/// One test of a file.
struct BroTest {
  Selection name;                 ///< value of each of kBroKeys that the file has
  SpecimenData specimen;          ///< water content and bulk density, where the file has them
  std::vector<std::size_t> rows;  ///< of the table, in its order
};

/// The tests of a file: rows that agree in all of kBroKeys, in the order of their first rows.
///
/// water_content_pct and bulk_density_g_cm3 are those of the first row. InputError: no column bro_id, one of
/// the two that is no possible value.
[[nodiscard]] std::vector<BroTest> find_bro_tests(const CsvTable& table);

/// The record of one of the tests: time_s (from the start of the step), step, vertical_stress_kPa,
/// strain_pct, optionally step_type (belastingstap: load, ontlastingstap: unload, relaxatie or
/// relaxatiestap).
///
/// A step begins when the one before ends, at its last reading. A relaxation step holds the strain, not a
/// load: it is left out and named. InputError: a column missing, a load that changes within a step, a number
/// or step_type that cannot be, fewer than 3 usable rows.
[[nodiscard]] OedometerRecord parse_bro(const CsvTable& table, const BroTest& test);

}  // namespace isotach::datasets
