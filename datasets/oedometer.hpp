// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Readings of one oedometer test in SI units, with every row that had to be left out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/csv_table.hpp"
#include "datasets/effective_stress.hpp"
#include "datasets/input_error.hpp"
#include "datasets/loading_stage.hpp"
#include "datasets/text_file.hpp"

namespace isotach::datasets {

/// One reading. Compression positive.
struct OedometerRow {
  std::size_t line;     ///< in the file
  double time;          ///< s, increasing strictly from row to row
  double axial_strain;  ///< engineering, dH/H0 (-), in (-1, 1)
  double axial_stress;  ///< effective, Pa, > 0; of a stress-controlled test the load of the step
  Stage stage;
  std::optional<double> base_pore_pressure;  ///< Pa, where the file has it
  std::optional<double> temperature;         ///< deg C, where the file has it
  std::optional<double> total_stress{};      ///< Pa, where the file states total stress
};

/// What the apparatus prescribes, and the data then answer.
enum class Control {
  strain,  ///< the strain history is the input, stress the answer (CRS)
  stress   ///< steps of load are the input, strain against time the answer (incremental loading)
};

/// One step of a stress-controlled test: a load and the readings under it.
struct LoadStep {
  double begin;       ///< s, when the load is put on; the test's time, as that of the rows
  double load;        ///< Pa, axial effective stress once pore pressures are gone, > 0
  Stage stage;        ///< load or unload, as recorded, else by comparison with the step before
  std::size_t first;  ///< index of the first of its rows
  std::size_t count;  ///< >= 1
};

/// A row that was left out or read otherwise than written, and why, for example
/// {264, "dropped: time 78300 s is not after 78421 s"}.
struct RowNote {
  std::size_t line;
  std::string what;
};

/// A file's readings.
struct OedometerRecord {
  std::filesystem::path file;
  std::vector<OedometerRow> rows;  ///< at least 3
  std::vector<RowNote> notes;
  std::vector<std::string> unknown_columns;        ///< columns of the file that were not read
  bool stages_deduced = false;                     ///< no stage column: deduced from the strains
  double stage_threshold = 0.0;                    ///< of that deduction (-), see deduce_stages
  bool stress_from_force = false;                  ///< the file has a force, not a stress
  std::optional<PorePressureCheck> pore_pressure;  ///< where a strain-controlled file has base pore pressures
  Control control = Control::strain;
  std::vector<LoadStep>
      steps;  ///< all of a stress-controlled test, in order; none of a strain-controlled one
};

/// The specimen, as far as readings are reduced with it.
struct Specimen {
  double height;                   ///< H0 (m), > 0
  std::optional<double> diameter;  ///< m, > 0; needed where the file has a force
};

/// What the study says of a file's readings.
struct OedometerReading {
  Control control = Control::strain;
  /// The file's stresses are total ones, to be reduced by this formula where the file has base pore
  /// pressures; nothing: they are effective. Only read of a strain-controlled test.
  std::optional<PorePressureFormula> total_by{};
};

/// Reads an oedometer file: time_s; one of axial_strain, axial_strain_% (or axial_strain_pct), height_mm,
/// displacement_mm (or settlement_mm); one of axial_stress_kPa, axial_force_kN (or force_kN); optionally
/// base_pore_pressure_kPa, temperature_C, stage (load, unload, hold, relax) and, where the test is
/// stress-controlled, step (any text).
///
/// Dropped and named: rows whose time is not after the latest before them, rows with no positive stress, or
/// none that is effective once the pore pressure is taken off.
///
/// Of a stress-controlled test the stress is the load. A step begins wherever the step, the load (by more
/// than 1e-3 of it) or the stage between load and unload changes: at the time of the row before it, at 0 if
/// it is the first; LoadStepBuilder says more.
/// InputError: what CsvTable refuses; no or several columns for strain or stress; a force without a diameter;
/// a number that is none or cannot be (a strain of 1, a height of 0); an unknown stage; fewer than 3 rows
/// left; a stress-controlled test that has rows before time 0.
[[nodiscard]] OedometerRecord read_oedometer(const std::filesystem::path& file, const Specimen& specimen,
                                             const OedometerReading& reading = {},
                                             const ReadOptions& options = {});
/// The same of a table in memory.
[[nodiscard]] OedometerRecord parse_oedometer(const CsvTable& table, const Specimen& specimen,
                                              const OedometerReading& reading = {});

/// `strain` (-), unless it is none that a specimen can have: numbers within the range of a column may round
/// to its ends once they are strains. InputError about `column`.
[[nodiscard]] double checked_strain(double strain, const FilePlace& place, std::string_view column);

/// The error of a file with fewer than 3 usable rows of `row_count`, naming the first of its notes.
[[nodiscard]] InputError too_few_rows(const OedometerRecord& record, std::size_t row_count);

}  // namespace isotach::datasets
