// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Readings of one oedometer test: implementation.
#include "datasets/oedometer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>

#include "datasets/csv_table.hpp"
#include "datasets/load_steps.hpp"

namespace isotach::datasets {
namespace {

/// Stresses (kPa) and forces (kN); beyond it no apparatus reads, and sums and squares stay finite.
constexpr Range kReading{-1e9, 1e9};
/// Readings' times; 30 000 years.
constexpr Range kTime_s{-1e12, 1e12};

/// How a column becomes a quantity: value = offset + factor * number.
struct Column {
  std::string_view name;
  double factor;
  double offset;
  Range accepted;
};

struct FoundColumn {
  std::size_t index;
  Column column;
};

double value_of(const CsvTable& table, std::size_t row, const FoundColumn& found) {
  return found.column.offset + found.column.factor * table.number(row, found.index, found.column.accepted);
}

/// The one of `candidates` that the table has.
FoundColumn find_one_of(const CsvTable& table, std::span<const Column> candidates) {
  std::optional<FoundColumn> found;
  for (const Column& candidate : candidates) {
    const auto index = table.find(candidate.name);
    if (!index) continue;
    if (found) {
      throw InputError(
          {table.file()}, "header",
          fmt::format("columns {} and {} state the same quantity", found->column.name, candidate.name),
          "one of them");
    }
    found = FoundColumn{*index, candidate};
  }
  if (found) return *found;
  std::vector<std::string_view> names;
  for (const Column& candidate : candidates) names.push_back(candidate.name);
  throw table.missing_column(fmt::format("{}", fmt::join(names, " or ")));
}

FoundColumn find_strain(const CsvTable& table, double height) {
  const double height_mm = 1e3 * height;
  const Range strain{-1.0, 1.0, true, true};
  const Range percent{-100.0, 100.0, true, true};
  const Range displacement{-height_mm, height_mm, true, true};
  const std::array<Column, 6> candidates{{
      {"axial_strain", 1.0, 0.0, strain},
      {"axial_strain_%", 1e-2, 0.0, percent},
      {"axial_strain_pct", 1e-2, 0.0, percent},
      {"height_mm", -1.0 / height_mm, 1.0, {0.0, 2.0 * height_mm, true, true}},
      {"displacement_mm", 1.0 / height_mm, 0.0, displacement},
      {"settlement_mm", 1.0 / height_mm, 0.0, displacement},
  }};
  return find_one_of(table, candidates);
}

FoundColumn find_stress(const CsvTable& table, const std::optional<double>& diameter) {
  const double area = diameter ? 0.25 * std::numbers::pi * *diameter * *diameter : 0.0;
  const double Pa_per_kN = diameter ? 1e3 / area : 0.0;
  const std::array<Column, 3> candidates{{
      {"axial_stress_kPa", 1e3, 0.0, kReading},
      {"axial_force_kN", Pa_per_kN, 0.0, kReading},
      {"force_kN", Pa_per_kN, 0.0, kReading},
  }};
  const FoundColumn found = find_one_of(table, candidates);
  if (!diameter && found.column.name != "axial_stress_kPa") {
    throw InputError({table.file()}, fmt::format("column {}", found.column.name),
                     "no diameter of the specimen is known", "a force together with the specimen's diameter");
  }
  return found;
}

std::optional<FoundColumn> find_optional(const CsvTable& table, const Column& column) {
  const auto index = table.find(column.name);
  if (!index) return std::nullopt;
  return FoundColumn{*index, column};
}

Stage stage_at(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string_view name = table.text(row, column);
  if (const auto stage = find_stage(name)) return *stage;
  throw InputError(table.place(row), "column stage", fmt::format("\"{}\" is not a stage", name),
                   "load, unload, hold or relax");
}

void deduce_stages_of(OedometerRecord& record) {
  std::vector<double> times;
  std::vector<double> strains;
  for (const OedometerRow& row : record.rows) {
    times.push_back(row.time);
    strains.push_back(row.axial_strain);
  }
  const DeducedStages deduced = deduce_stages(times, strains);
  for (std::size_t i = 0; i < record.rows.size(); ++i) record.rows[i].stage = deduced.stages[i];
  record.stages_deduced = true;
  record.stage_threshold = deduced.threshold;
}

/// The columns of a file that are read, checked before any row is.
class Columns {
 public:
  Columns(const CsvTable& table, const Specimen& specimen, const OedometerReading& reading)
      : table_(table),
        time_(table.require("time_s")),
        strain_(find_strain(table, specimen.height)),
        stress_(find_stress(table, specimen.diameter)),
        pore_pressure_(find_optional(table, {"base_pore_pressure_kPa", 1e3, 0.0, kReading})),
        temperature_(find_optional(table, {"temperature_C", 1.0, 0.0, {-273.15, 1e4}})),
        stage_(table.find("stage")) {
    if (reading.control == Control::stress) step_ = table.find("step");
  }

  [[nodiscard]] bool has_stage() const { return stage_.has_value(); }
  [[nodiscard]] bool has_force() const { return stress_.column.name != "axial_stress_kPa"; }
  [[nodiscard]] std::vector<std::string> unknown() const {
    std::vector<bool> known(table_.columns().size(), false);
    for (const std::size_t index : {time_, strain_.index, stress_.index}) known[index] = true;
    if (pore_pressure_) known[pore_pressure_->index] = true;
    if (temperature_) known[temperature_->index] = true;
    if (stage_) known[*stage_] = true;
    if (step_) known[*step_] = true;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (!known[i]) names.push_back(table_.columns()[i]);
    }
    return names;
  }

  [[nodiscard]] OedometerRow row(std::size_t i) const {
    OedometerRow row{};
    row.line = table_.place(i).line;
    row.time = table_.number(i, time_, kTime_s);
    row.axial_strain = checked_strain(value_of(table_, i, strain_), table_.place(i), strain_.column.name);
    row.axial_stress = value_of(table_, i, stress_);
    if (pore_pressure_) row.base_pore_pressure = value_of(table_, i, *pore_pressure_);
    if (temperature_) row.temperature = value_of(table_, i, *temperature_);
    if (stage_) row.stage = stage_at(table_, i, *stage_);
    return row;
  }
  /// The row's cell in the column step; empty where there is none.
  [[nodiscard]] std::string_view step(std::size_t i) const {
    return step_ ? table_.text(i, *step_) : std::string_view();
  }

 private:
  const CsvTable& table_;
  std::size_t time_;
  FoundColumn strain_;
  FoundColumn stress_;
  std::optional<FoundColumn> pore_pressure_;
  std::optional<FoundColumn> temperature_;
  std::optional<std::size_t> stage_;
  std::optional<std::size_t> step_;
};

/// Whether the row has a positive stress; a note says where it has not.
bool has_stress(const OedometerRow& row, std::vector<RowNote>& notes) {
  if (row.axial_stress > 0.0) return true;
  notes.push_back(
      {row.line, fmt::format("dropped: axial stress {:.4g} kPa is not positive", 1e-3 * row.axial_stress)});
  return false;
}

/// Takes the pore pressure off the row's total stress. False, with a note, where nothing is left.
bool reduce(OedometerRow& row, PorePressureFormula formula, std::vector<RowNote>& notes) {
  row.total_stress = row.axial_stress;
  if (!row.base_pore_pressure) return true;
  const auto effective = effective_stress(*row.total_stress, *row.base_pore_pressure, formula);
  if (effective) {
    row.axial_stress = *effective;
    return true;
  }
  notes.push_back({row.line, fmt::format("dropped: of the total stress {:.4g} kPa the base pore pressure "
                                         "{:.4g} kPa leaves no positive effective stress",
                                         1e-3 * *row.total_stress, 1e-3 * *row.base_pore_pressure)});
  return false;
}

void read_rows(const CsvTable& table, const Columns& columns,
               const std::optional<PorePressureFormula>& total_by, OedometerRecord& record) {
  double latest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    OedometerRow row = columns.row(i);
    if (!(row.time > latest)) {
      record.notes.push_back(
          {row.line, fmt::format("dropped: time {} s is not after {} s", row.time, latest)});
      continue;
    }
    latest = row.time;
    if (!has_stress(row, record.notes)) continue;
    if (total_by && !reduce(row, *total_by, record.notes)) continue;
    record.rows.push_back(row);
  }
}

void check_pore_pressures_of(OedometerRecord& record, const std::optional<PorePressureFormula>& reduced_by) {
  if (record.rows.empty() || !record.rows.front().base_pore_pressure) return;
  std::vector<double> total;
  std::vector<double> base;
  for (const OedometerRow& row : record.rows) {
    if (row.stage != Stage::load) continue;
    base.push_back(row.base_pore_pressure.value());
    total.push_back(row.total_stress.value_or(linear_total_stress(row.axial_stress, base.back())));
  }
  record.pore_pressure = check_pore_pressures(total, base, reduced_by);
}

void read_steps(const CsvTable& table, const Columns& columns, OedometerRecord& record) {
  LoadStepBuilder steps(record);
  double latest = 0.0;
  double load = 0.0;  // of the step that is open
  std::string_view step;
  std::optional<Stage> direction;
  int count = 0;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    const OedometerRow row = columns.row(i);
    if (row.time < 0.0) {
      throw InputError(table.place(i), "column time_s", fmt::format("{} is before the start", row.time),
                       ">= 0 in a stress-controlled test, whose first load is put on at time 0");
    }
    if (!has_stress(row, record.notes)) continue;
    const bool moves = columns.has_stage() && (row.stage == Stage::load || row.stage == Stage::unload);
    const bool turns = moves && direction && *direction != row.stage;
    const bool changes = columns.step(i) != step || !same_load(row.axial_stress, load) || turns;
    if (count == 0 || (changes && row.time >= latest)) {
      ++count;
      load = row.axial_stress;
      step = columns.step(i);
      direction = moves ? std::optional(row.stage) : std::nullopt;
      steps.open(row.line, step.empty() ? std::to_string(count) : std::string(step), latest, direction);
    } else if (moves && !direction) {
      direction = row.stage;
    }
    steps.add(row);
    latest = std::max(latest, row.time);
  }
  steps.finish();
}

}  // namespace

double checked_strain(double strain, const FilePlace& place, std::string_view column) {
  if (strain > -1.0 && strain < 1.0) return strain;
  throw InputError(place, fmt::format("column {}", column),
                   fmt::format("it means a strain of {:.6g}", strain), "a strain > -1 and < 1");
}

InputError too_few_rows(const OedometerRecord& record, std::size_t row_count) {
  const std::string first_note =
      record.notes.empty() ? "" : fmt::format(" (line {} {})", record.notes[0].line, record.notes[0].what);
  return {{record.file},
          "rows",
          fmt::format("{} usable of {}{}", record.rows.size(), row_count, first_note),
          "at least 3 with increasing time and positive stress"};
}

OedometerRecord read_oedometer(const std::filesystem::path& file, const Specimen& specimen,
                               const OedometerReading& reading, const ReadOptions& options) {
  return parse_oedometer(CsvTable::read(file, options), specimen, reading);
}

OedometerRecord parse_oedometer(const CsvTable& table, const Specimen& specimen,
                                const OedometerReading& reading) {
  const Columns columns(table, specimen, reading);
  OedometerRecord record;
  record.file = table.file();
  record.unknown_columns = columns.unknown();
  record.stress_from_force = columns.has_force();
  if (reading.control == Control::stress) {
    read_steps(table, columns, record);
  } else {
    read_rows(table, columns, reading.total_by, record);
  }
  if (record.rows.size() < 3) throw too_few_rows(record, table.row_count());
  if (reading.control == Control::stress) return record;
  if (!columns.has_stage()) deduce_stages_of(record);
  check_pore_pressures_of(record, reading.total_by);
  return record;
}

}  // namespace isotach::datasets
