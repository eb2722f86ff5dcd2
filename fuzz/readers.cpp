// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The readers of user files fed with arbitrary bytes, and what must hold of all that they accept.
#include "fuzz/readers.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "datasets/ags4_oedometer.hpp"
#include "datasets/bro.hpp"
#include "datasets/csv_table.hpp"
#include "datasets/input_error.hpp"
#include "datasets/oedometer.hpp"
#include "datasets/outline.hpp"
#include "datasets/study.hpp"

namespace isotach::fuzz {
namespace {

using namespace isotach::datasets;

void require(bool holds, const char* promise) {
  if (!holds) throw std::logic_error(promise);
}

void check_rows(const OedometerRecord& record) {
  require(record.rows.size() >= 3, "at least 3 rows");
  for (std::size_t i = 0; i < record.rows.size(); ++i) {
    const OedometerRow& row = record.rows[i];
    require(std::isfinite(row.time), "a finite time");
    require(i == 0 || row.time > record.rows[i - 1].time, "times that increase");
    require(row.axial_strain > -1.0 && row.axial_strain < 1.0, "a strain within (-1, 1)");
    require(row.axial_stress > 0.0 && std::isfinite(row.axial_stress), "a positive stress");
  }
  require(record.stages_deduced == (record.stages_deduced && record.control == Control::strain),
          "stages deduced from strains only where strain is controlled");
  if (!record.pore_pressure) return;
  require(std::isfinite(record.pore_pressure->least_ratio), "a finite least ratio");
  require(record.pore_pressure->least_ratio <= record.pore_pressure->greatest_ratio, "ratios in order");
  require(record.pore_pressure->outside <= record.pore_pressure->loading_rows, "no more outside than rows");
}

void check_steps(const OedometerRecord& record) {
  require((record.control == Control::stress) == !record.steps.empty(), "steps where stress is controlled");
  std::size_t next = 0;
  double end = 0.0;
  for (const LoadStep& step : record.steps) {
    require(step.first == next && step.count >= 1, "steps that hold all rows in order");
    require(step.load > 0.0 && std::isfinite(step.load), "a positive load");
    require(step.begin >= end, "a step that begins when the one before is over");
    require(step.stage == Stage::load || step.stage == Stage::unload, "load or unload");
    next += step.count;
    require(next <= record.rows.size() && record.rows[step.first].time > step.begin,
            "readings under the load");
    end = record.rows[next - 1].time;
  }
  if (record.control == Control::stress) require(next == record.rows.size(), "every row in a step");
}

void check(const OedometerRecord& record) {
  check_rows(record);
  check_steps(record);
}

void check(const Study& study) {
  require(!study.oedometer_tests.empty() || !study.slump_tests.empty(), "at least one test");
  for (const OedometerTest& test : study.oedometer_tests) {
    check(test.record);
    require(test.void_ratio > 0.0 && std::isfinite(test.void_ratio), "a positive void ratio");
    require(test.initial_K0 > 0.0 && std::isfinite(test.initial_K0), "a positive K0");
    require(test.height > 0.0, "a positive height");
  }
}

void read_study_text(std::string_view text, const char* name) {
  constexpr std::string_view kSeparator = "\n----\n";
  const std::size_t at = text.find(kSeparator);
  const bool split = at != std::string_view::npos;
  const std::string data(split ? text.substr(at + kSeparator.size()) : std::string_view("a,b\n1,2\n"));
  const ReadText read_data = [&](const std::filesystem::path&) { return data; };
  check(parse_study(std::string(text.substr(0, at)), name, read_data));
}

void read_with(unsigned reader, std::string text) {
  constexpr Specimen kSpecimen{0.02, 0.05};
  switch (reader) {
    case 0:
      check(parse_oedometer(CsvTable::parse(std::move(text), "data.csv"), kSpecimen,
                            {Control::strain, PorePressureFormula::nonlinear}));
      return;
    case 1:
      check(parse_oedometer(CsvTable::parse(std::move(text), "data.csv"), kSpecimen,
                            {Control::stress, std::nullopt}));
      return;
    case 2:
      for (const Outline& outline : parse_outlines(CsvTable::parse(std::move(text), "data.csv"))) {
        require(outline.points.size() >= 3, "at least 3 points");
      }
      return;
    case 4: {
      const CsvTable table = CsvTable::parse(std::move(text), "data.csv");
      for (const BroTest& test : find_bro_tests(table)) check(parse_bro(table, test));
      return;
    }
    case 5: {
      const Ags4File file = Ags4File::parse(std::move(text), "data.ags");
      for (Ags4Oedometer& test : find_ags4_oedometers(file)) {
        const Ags4Oedometer read = read_ags4_oedometer(file, std::move(test));
        check(record_of(file, read, read.specimen.void_ratio.value_or(1.0)));
      }
      return;
    }
    default:  // the data key of the study and the header of the data tell their format
      read_study_text(text, "study.toml");
  }
}

}  // namespace

bool read_bytes(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return false;
  std::string text(bytes.begin() + 1, bytes.end());
  try {
    read_with(bytes.front() % kReaders, std::move(text));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace isotach::fuzz
