// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The data file of an [[oedometer]] table: implementation.
#include "datasets/oedometer_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "datasets/ags4_oedometer.hpp"
#include "datasets/bro.hpp"
#include "datasets/csv_table.hpp"

namespace isotach::datasets {
namespace {

bool is_ags(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix == ".ags" || suffix == ".ags4";
}

Selection read_selection(TomlTable& test) {
  Selection selection;
  auto table = test.table_if("select");
  if (!table) return selection;
  const auto take = [&](std::string_view key) {
    if (auto value = table->text_or_number_if(key)) selection.emplace_back(key, *std::move(value));
  };
  for (const std::string_view key : kBroKeys) take(key);
  for (const std::string_view key : kAgs4SpecimenKeys) take(key);
  table->reject_unknown_keys();
  return selection;
}

/// The one test that the study selects of those found in a file; throws InputError where that is none or
/// several.
template <class Found>
const Found& selected(const std::vector<Found>& tests, const TomlTable& test, const DataRequest& request,
                      std::span<const std::string_view> keys, std::string_view format) {
  for (const auto& [key, value] : request.select) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      throw test.error("select", fmt::format("{} tells no tests of a file in {} format apart", key, format),
                       fmt::format("{}", fmt::join(keys, ", ")));
    }
  }
  std::vector<Selection> names;
  for (const Found& found : tests) names.push_back(found.name);
  const SelectedTest chosen = select_test(names, request.select);
  if (!chosen.index) throw InputError(test.place(), "key select", chosen.problem, "one of them");
  return tests[*chosen.index];
}

/// Refuses what is only stated of constant-rate tests where the format is one of load steps.
void check_stepped(const TomlTable& test, const DataRequest& request, std::string_view format) {
  if (request.protocol == Control::strain) {
    throw test.error("protocol", fmt::format("\"strain\" for a file in {} format", format), "\"stress\"");
  }
  if (request.reading.total_by) {
    throw test.error("stress", "\"total\" for a stress-controlled test",
                     "\"effective\", as readings are compared once pore pressures are gone");
  }
}

/// What the study states, filled up by what the file does. The void ratio and the masses it follows from stay
/// the file's, as the study's are keys of their own.
SpecimenData merged(const SpecimenData& stated, SpecimenData of_file) {
  if (stated.height) of_file.height = stated.height;
  if (stated.diameter) of_file.diameter = stated.diameter;
  return of_file;
}

OedometerData read_csv(const TomlTable& test, const DataRequest& request, const CsvTable& table,
                       const VoidRatioOf& void_ratio_of) {
  if (!request.select.empty()) {
    throw test.error("select", "given for a file of one test", "select for files in BRO or AGS4 format");
  }
  if (request.reading.control == Control::stress) check_stepped(test, request, "CSV");
  if (!request.specimen.height) {
    throw test.error("height_mm", "it is missing", "the specimen's height, > 0 and <= 1000");
  }
  OedometerData data;
  data.specimen = request.specimen;
  static_cast<void>(void_ratio_of(data.specimen));
  data.record = parse_oedometer(table, {*data.specimen.height, data.specimen.diameter}, request.reading);
  return data;
}

OedometerData read_bro(const TomlTable& test, const DataRequest& request, const CsvTable& table,
                       const VoidRatioOf& void_ratio_of) {
  check_stepped(test, request, "BRO");
  const std::vector<BroTest> tests = find_bro_tests(table);
  const BroTest& chosen = selected(tests, test, request, kBroKeys, "BRO");
  OedometerData data;
  data.specimen = merged(request.specimen, chosen.specimen);
  static_cast<void>(void_ratio_of(data.specimen));
  data.record = parse_bro(table, chosen);
  return data;
}

OedometerData read_ags4(const TomlTable& test, const DataRequest& request, const Ags4File& file,
                        const VoidRatioOf& void_ratio_of) {
  check_stepped(test, request, "AGS4");
  const std::vector<Ags4Oedometer> tests = find_ags4_oedometers(file);
  Ags4Oedometer chosen = read_ags4_oedometer(file, selected(tests, test, request, kAgs4SpecimenKeys, "AGS4"));
  OedometerData data;
  data.specimen = merged(request.specimen, std::move(chosen.specimen));
  const double void_ratio = void_ratio_of(data.specimen);
  data.record = record_of(file, chosen, data.specimen.void_ratio.value_or(void_ratio));
  data.specimen.assumptions.push_back("AGS4 files hold no times: each load taken to last 24 h");
  data.ends_of_steps_only = true;
  return data;
}

}  // namespace

DataRequest read_data_request(TomlTable& test) {
  DataRequest request;
  request.file = test.text("data");
  constexpr std::array<std::string_view, 3> kFormats{"csv", "bro", "ags4"};
  constexpr std::array<DataFormat, 3> kFormatValues{DataFormat::csv, DataFormat::bro, DataFormat::ags4};
  if (const auto format = test.choice_if("format", kFormats)) request.format = kFormatValues[*format];
  request.select = read_selection(test);
  constexpr std::array<std::string_view, 2> kProtocols{"strain", "stress"};
  if (const auto protocol = test.choice_if("protocol", kProtocols)) {
    request.protocol = *protocol == 0 ? Control::strain : Control::stress;
  }
  request.reading.control = request.protocol.value_or(Control::strain);
  constexpr std::array<std::string_view, 2> kStresses{"effective", "total"};
  const bool total = test.choice_if("stress", kStresses).value_or(0) == 1;
  constexpr std::array<std::string_view, 2> kFormulas{"linear", "nonlinear"};
  const auto formula = test.choice_if("pore_pressure", kFormulas);
  if (formula && !total) {
    throw test.error("pore_pressure", "given, but the stress is effective already",
                     "pore_pressure only together with stress = \"total\"");
  }
  if (total) {
    request.reading.total_by =
        formula.value_or(0) == 0 ? PorePressureFormula::linear : PorePressureFormula::nonlinear;
  }
  return request;
}

OedometerData read_oedometer_data(const TomlTable& test, const DataRequest& request, std::string text,
                                  const VoidRatioOf& void_ratio_of) {
  const bool ags4 = request.format ? *request.format == DataFormat::ags4 : is_ags(request.file);
  if (ags4) return read_ags4(test, request, Ags4File::parse(std::move(text), request.file), void_ratio_of);
  const CsvTable table = CsvTable::parse(std::move(text), request.file);
  const bool bro = request.format ? *request.format == DataFormat::bro : is_bro(table);
  return bro ? read_bro(test, request, table, void_ratio_of) : read_csv(test, request, table, void_ratio_of);
}

}  // namespace isotach::datasets
