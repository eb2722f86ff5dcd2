// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Readings of one oedometer test: implementation.
#include "datasets/oedometer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <span>
#include <string_view>

#include "datasets/csv_table.hpp"

namespace isotach::datasets {
namespace {

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
      {"axial_stress_kPa", 1e3, 0.0, {}},
      {"axial_force_kN", Pa_per_kN, 0.0, {}},
      {"force_kN", Pa_per_kN, 0.0, {}},
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

}  // namespace

OedometerRecord read_oedometer(const std::filesystem::path& file, const Specimen& specimen,
                               const ReadOptions& options) {
  const CsvTable table = CsvTable::read(file, options);
  const std::size_t time_column = table.require("time_s");
  const FoundColumn strain_column = find_strain(table, specimen.height);
  const FoundColumn stress_column = find_stress(table, specimen.diameter);
  const auto pore_pressure_column = find_optional(table, {"base_pore_pressure_kPa", 1e3, 0.0, {}});
  const auto temperature_column = find_optional(table, {"temperature_C", 1.0, 0.0, {-273.15}});
  const auto stage_column = table.find("stage");

  OedometerRecord record;
  record.file = file;
  std::vector<bool> known(table.columns().size(), false);
  for (const std::size_t index : {time_column, strain_column.index, stress_column.index}) known[index] = true;
  if (pore_pressure_column) known[pore_pressure_column->index] = true;
  if (temperature_column) known[temperature_column->index] = true;
  if (stage_column) known[*stage_column] = true;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!known[i]) record.unknown_columns.push_back(table.columns()[i]);
  }

  double latest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    const std::size_t line = table.place(i).line;
    OedometerRow row{};
    row.line = line;
    row.time = table.number(i, time_column);
    row.axial_strain = value_of(table, i, strain_column);
    row.axial_stress = value_of(table, i, stress_column);
    if (pore_pressure_column) row.base_pore_pressure = value_of(table, i, *pore_pressure_column);
    if (temperature_column) row.temperature = value_of(table, i, *temperature_column);
    if (stage_column) row.stage = stage_at(table, i, *stage_column);
    if (!(row.time > latest)) {
      record.notes.push_back({line, fmt::format("dropped: time {} s is not after {} s", row.time, latest)});
      continue;
    }
    latest = row.time;
    if (!(row.axial_stress > 0.0)) {
      record.notes.push_back(
          {line, fmt::format("dropped: axial stress {:.4g} kPa is not positive", 1e-3 * row.axial_stress)});
      continue;
    }
    record.rows.push_back(row);
  }
  if (record.rows.size() < 3) {
    const std::string first_note =
        record.notes.empty() ? "" : fmt::format(" (line {} {})", record.notes[0].line, record.notes[0].what);
    throw InputError({file}, "rows",
                     fmt::format("{} usable of {}{}", record.rows.size(), table.row_count(), first_note),
                     "at least 3 with increasing time and positive stress");
  }
  if (!stage_column) deduce_stages_of(record);
  return record;
}

}  // namespace isotach::datasets
