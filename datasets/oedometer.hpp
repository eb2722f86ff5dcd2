// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Readings of one oedometer test in SI units, with every row that had to be left out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/loading_stage.hpp"
#include "datasets/text_file.hpp"

namespace isotach::datasets {

/// One reading. Compression positive.
struct OedometerRow {
  std::size_t line;     ///< in the file
  double time;          ///< s, increasing strictly from row to row
  double axial_strain;  ///< engineering, dH/H0 (-), in (-1, 1)
  double axial_stress;  ///< Pa, > 0
  Stage stage;
  std::optional<double> base_pore_pressure;  ///< Pa, where the file has it
  std::optional<double> temperature;         ///< deg C, where the file has it
};

/// A row that was left out and why, for example {264, "dropped: time 78300 s is not after 78421 s"}.
struct RowNote {
  std::size_t line;
  std::string what;
};

/// A file's readings.
struct OedometerRecord {
  std::filesystem::path file;
  std::vector<OedometerRow> rows;  ///< at least 3
  std::vector<RowNote> notes;
  std::vector<std::string> unknown_columns;  ///< columns of the file that were not read
  bool stages_deduced = false;               ///< no stage column: deduced from the strains
  double stage_threshold = 0.0;              ///< of that deduction (-), see deduce_stages
};

/// The specimen, as far as readings are reduced with it.
struct Specimen {
  double height;                   ///< H0 (m), > 0
  std::optional<double> diameter;  ///< m, > 0; needed where the file has a force
};

/// Reads an oedometer file: time_s; one of axial_strain, axial_strain_% (or axial_strain_pct), height_mm,
/// displacement_mm (or settlement_mm); one of axial_stress_kPa, axial_force_kN (or force_kN); optionally
/// base_pore_pressure_kPa, temperature_C and stage (load, unload, hold, relax).
///
/// Dropped and named: rows whose time is not after the latest before them, rows with no positive stress.
/// InputError: what CsvTable refuses; no or several columns for strain or stress; a force without a diameter;
/// a number that is none or cannot be (a strain of 1, a height of 0); an unknown stage; fewer than 3 rows
/// left.
[[nodiscard]] OedometerRecord read_oedometer(const std::filesystem::path& file, const Specimen& specimen,
                                             const ReadOptions& options = {});

}  // namespace isotach::datasets
