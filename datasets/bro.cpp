// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Oedometer tests of the Dutch subsurface registry: implementation.
#include "datasets/bro.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "datasets/load_steps.hpp"
#include "datasets/soil_ranges.hpp"

namespace isotach::datasets {
namespace {

constexpr Range kStepTime_s{0.0, 1e9};
constexpr Range kLoad_kPa = Range::positive(1e6);
constexpr Range kStrain_pct{-100.0, 100.0, true, true};

/// What the registry's word for a step says.
Stage step_type(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string_view word = table.text(row, column);
  if (word == "belastingstap") return Stage::load;
  if (word == "ontlastingstap") return Stage::unload;
  if (word == "relaxatie" || word == "relaxatiestap") return Stage::relax;
  throw InputError(table.place(row), "column step_type", fmt::format("\"{}\" is not a type of step", word),
                   "belastingstap, ontlastingstap or relaxatiestap");
}

SpecimenData specimen_at(const CsvTable& table, std::size_t row) {
  SpecimenData specimen;
  if (const auto column = table.find("water_content_pct"); column && !table.text(row, *column).empty()) {
    specimen.water_content = 1e-2 * table.number(row, *column, kWaterContent_pct);
  }
  if (const auto column = table.find("bulk_density_g_cm3"); column && !table.text(row, *column).empty()) {
    specimen.bulk_density = 1e3 * table.number(row, *column, kDensity);
  }
  return specimen;
}

struct Columns {
  explicit Columns(const CsvTable& table)
      : time(table.require("time_s")),
        step(table.require("step")),
        load(table.require("vertical_stress_kPa")),
        strain(table.require("strain_pct")),
        type(table.find("step_type")) {}

  [[nodiscard]] OedometerRow row(const CsvTable& table, std::size_t i, double begin) const {
    OedometerRow row{};
    row.line = table.place(i).line;
    row.time = begin + table.number(i, time, kStepTime_s);
    row.axial_strain =
        checked_strain(1e-2 * table.number(i, strain, kStrain_pct), table.place(i), "strain_pct");
    row.axial_stress = 1e3 * table.number(i, load, kLoad_kPa);
    return row;
  }

  std::size_t time;
  std::size_t step;
  std::size_t load;
  std::size_t strain;
  std::optional<std::size_t> type;
};

std::vector<std::string> unknown_columns(const CsvTable& table) {
  constexpr std::array<std::string_view, 9> kKnown{
      "bro_id",    "begin_depth_m", "water_content_pct",   "bulk_density_g_cm3", "step",
      "step_type", "time_s",        "vertical_stress_kPa", "strain_pct"};
  std::vector<std::string> unknown;
  for (const std::string& column : table.columns()) {
    if (std::find(kKnown.begin(), kKnown.end(), column) == kKnown.end()) unknown.push_back(column);
  }
  return unknown;
}

}  // namespace

bool is_bro(const CsvTable& table) {
  return table.find(kBroKeys[0]).has_value();
}

std::vector<BroTest> find_bro_tests(const CsvTable& table) {
  std::vector<std::pair<std::string_view, std::size_t>> keys{{kBroKeys[0], table.require(kBroKeys[0])}};
  if (const auto depth = table.find(kBroKeys[1])) keys.emplace_back(kBroKeys[1], *depth);

  std::vector<BroTest> tests;
  std::map<std::vector<std::string_view>, std::size_t> index;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    std::vector<std::string_view> values;
    for (const auto& [name, column] : keys) values.push_back(table.text(row, column));
    const auto [found, is_new] = index.try_emplace(values, tests.size());
    if (is_new) {
      Selection name;
      for (std::size_t i = 0; i < keys.size(); ++i) name.emplace_back(keys[i].first, values[i]);
      tests.push_back({std::move(name), specimen_at(table, row), {}});
    }
    tests[found->second].rows.push_back(row);
  }
  return tests;
}

OedometerRecord parse_bro(const CsvTable& table, const BroTest& test) {
  const Columns columns(table);
  OedometerRecord record;
  record.file = table.file();
  record.unknown_columns = unknown_columns(table);
  LoadStepBuilder steps(record);
  std::string_view step;
  double begin = 0.0;  // of the step that is open
  double end = 0.0;    // latest reading so far
  double load = 0.0;   // of the step that is open
  bool relaxes = false;
  bool first = true;
  for (const std::size_t i : test.rows) {
    const bool opens = first || table.text(i, columns.step) != step;
    if (opens) begin = end;
    const OedometerRow row = columns.row(table, i, begin);
    if (opens) {
      first = false;
      step = table.text(i, columns.step);
      load = row.axial_stress;
      const auto type = columns.type ? std::optional(step_type(table, i, *columns.type)) : std::nullopt;
      relaxes = type == Stage::relax;
      if (relaxes) {
        record.notes.push_back(
            {row.line,
             fmt::format("step {} left out: a relaxation, which holds the strain and no load", step)});
      } else {
        steps.open(row.line, std::string(step), begin, type);
      }
    } else if (!same_load(row.axial_stress, load)) {
      throw InputError(table.place(i), "column vertical_stress_kPa",
                       fmt::format("{:.6g} in step {}, which began with {:.6g}", 1e-3 * row.axial_stress,
                                   step, 1e-3 * load),
                       "one load in each step");
    }
    end = std::max(end, row.time);
    if (!relaxes) steps.add(row);
  }
  steps.finish();
  if (record.rows.size() < 3) throw too_few_rows(record, test.rows.size());
  return record;
}

}  // namespace isotach::datasets
