// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [[oedometer]] of a study: implementation.
#include "datasets/oedometer_section.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "datasets/oedometer_data.hpp"
#include "datasets/study_sections.hpp"
#include "datasets/void_ratio.hpp"

namespace isotach::datasets {
namespace {

/// Specimens of an oedometer; what is larger is a mistake of unit.
constexpr Range kSpecimen_mm = Range::positive(1000.0);
constexpr Range kK0{0.0, 3.0, true, true};
constexpr Range kOcr = Range::positive(100.0);
/// Height (m) where neither study nor file gives one; of most incremental-loading apparatuses.
constexpr double kAssumedHeight = 0.02;

OedometerNoise read_oedometer_noise(TomlTable& test, Assumptions& assumptions) {
  OedometerNoise noise;
  auto table = test.table_if("noise");
  std::optional<double> relative;
  std::optional<double> floor_kPa;
  std::optional<double> strain;
  if (table) {
    relative = table->number_if("stress_relative", {0.0, 1.0});
    floor_kPa = table->number_if("stress_floor_kPa", Range::positive(1000.0));
    strain = table->number_if("strain", Range::positive(0.1));
    table->reject_unknown_keys();
  }
  noise.stress_relative = relative.value_or(noise.stress_relative);
  if (floor_kPa) noise.stress_floor = 1e3 * *floor_kPa;
  noise.strain = strain.value_or(noise.strain);
  if (!relative) {
    assumptions.add(fmt::format("noise of stress not given, {} of it assumed", noise.stress_relative));
  }
  if (!floor_kPa) {
    assumptions.add(
        fmt::format("floor of the noise of stress not given, {} kPa assumed", 1e-3 * noise.stress_floor));
  }
  if (!strain) assumptions.add(fmt::format("noise of strain not given, {} assumed", noise.strain));
  return noise;
}

struct StartValue {
  double value;
  FreeStart free;
};

/// A number, or { value, std_error } that moves with the fit.
std::optional<StartValue> read_start_value(TomlTable& test, std::string_view key, const Range& accepted,
                                           const Range& std_error) {
  if (!test.is_table(key)) {
    const auto value = test.number_if(key, accepted);
    if (!value) return std::nullopt;
    return StartValue{*value, {}};
  }
  auto table = test.table(key);
  StartValue start{table.number("value", accepted), {true, table.number_if("std_error", std_error)}};
  table.reject_unknown_keys();
  return start;
}

void read_initial_K0(TomlTable& table, double phi_c, OedometerTest& test, Assumptions& assumptions) {
  constexpr std::string_view kKey = "initial_K0";
  const double jaky = 1.0 - std::sin(phi_c);
  if (table.is_text(kKey)) {
    constexpr std::array<std::string_view, 2> kRules{"jaky", "steady"};
    test.K0_rule = table.choice_if(kKey, kRules).value_or(0) == 0 ? InitialK0::jaky : InitialK0::steady;
    test.initial_K0 = jaky;
  } else if (const auto start = read_start_value(table, kKey, kK0, Range::positive(10.0))) {
    test.K0_rule = InitialK0::given;
    test.initial_K0 = start->value;
    test.free_K0 = start->free;
  } else {
    test.K0_rule = InitialK0::jaky;
    test.initial_K0 = jaky;
    assumptions.add(fmt::format("initial K0 not given, 1 - sin(phi_c) = {:.4f} (Jaky) assumed", jaky));
  }
}

std::optional<EndOfPrimary> read_end_of_primary(TomlTable& table) {
  constexpr std::string_view kKey = "end_of_primary";
  using Rule = EndOfPrimary::Rule;
  if (!table.is_text(kKey)) {
    const auto seconds = table.number_if(kKey, Range::positive(1e9));
    if (!seconds) return std::nullopt;
    return EndOfPrimary{Rule::given, *seconds};
  }
  constexpr std::array<std::string_view, 3> kRules{"taylor", "casagrande", "none"};
  constexpr std::array<Rule, 3> kRuleValues{Rule::taylor, Rule::casagrande, Rule::none};
  return EndOfPrimary{kRuleValues[table.choice_if(kKey, kRules).value_or(0)], 0.0};
}

/// The rule for the end of primary consolidation, which only a stress-controlled test has a use for.
EndOfPrimary choose_end_of_primary(const TomlTable& table, const std::optional<EndOfPrimary>& stated,
                                   const OedometerData& data) {
  if (stated && data.record.control == Control::strain) {
    throw table.error("end_of_primary", "given for a strain-controlled test",
                      "end_of_primary only where loads are stepped");
  }
  if (data.ends_of_steps_only) {
    if (stated && stated->rule != EndOfPrimary::Rule::none) {
      throw table.error("end_of_primary", "the data hold the end of each step only", "\"none\", or no key");
    }
    return {EndOfPrimary::Rule::none, 0.0};
  }
  return stated.value_or(EndOfPrimary{});
}

/// Names what the stresses are taken for where neither study nor file is clear.
void name_stress_assumptions(TomlTable& table, const OedometerRecord& record, bool total,
                             Assumptions& assumptions) {
  if (total && !record.pore_pressure) {
    assumptions.add("no base pore pressure recorded, total stress taken as effective");
  } else if (record.stress_from_force && !table.has("stress")) {
    assumptions.add("whether the force gives total or effective stress not stated, effective assumed");
  }
}

}  // namespace

OedometerTest read_oedometer_test(TomlTable table, const StudyContext& study) {
  OedometerTest test{};
  test.name = read_test_name(table, study.names);
  Assumptions assumptions("oedometer test " + test.name, study.assumptions);
  DataRequest request = read_data_request(table);
  request.file = study.file.parent_path() / request.file;
  if (const auto height = table.number_if("height_mm", kSpecimen_mm)) {
    request.specimen.height = 1e-3 * *height;
  }
  if (const auto diameter = table.number_if("diameter_mm", kSpecimen_mm)) {
    request.specimen.diameter = 1e-3 * *diameter;
  }
  const VoidRatioKeys void_ratio_keys = read_void_ratio_keys(table);
  read_initial_K0(table, study.material.phi_c(), test, assumptions);
  if (const auto ocr = read_start_value(table, "initial_ocr", kOcr, Range::positive(10.0))) {
    test.initial_ocr = ocr->value;
    test.free_ocr = ocr->free;
  }
  if (const auto stress = table.number_if("initial_axial_stress_kPa", Range::positive(1e5))) {
    test.initial_axial_stress = 1e3 * *stress;
  }
  const auto end_of_primary = read_end_of_primary(table);
  test.noise = read_oedometer_noise(table, assumptions);
  test.hold_out = table.boolean_if("hold_out").value_or(false);
  table.reject_unknown_keys();

  const auto void_ratio_of = [&](const SpecimenData& specimen) {
    VoidRatio void_ratio = work_out_void_ratio(table, void_ratio_keys, specimen, assumptions);
    test.void_ratio = void_ratio.value;
    test.void_ratio_source = std::move(void_ratio.source);
    test.void_ratio_per_specific_gravity = void_ratio.per_specific_gravity;
    return test.void_ratio;
  };
  OedometerData data = read_oedometer_data(table, request, study.read_data(request.file), void_ratio_of);
  for (const std::string& assumption : data.specimen.assumptions) assumptions.add(assumption);
  if (!data.specimen.height) {
    assumptions.add(
        fmt::format("height of the specimen not given, {:.0f} mm assumed where a length is needed",
                    1e3 * kAssumedHeight));
  }
  test.height = data.specimen.height.value_or(kAssumedHeight);
  test.diameter = data.specimen.diameter;
  test.end_of_primary = choose_end_of_primary(table, end_of_primary, data);
  name_stress_assumptions(table, data.record, request.reading.total_by.has_value(), assumptions);
  test.record = std::move(data.record);
  if (test.initial_axial_stress && test.record.rows.front().time < 0.0) {
    throw InputError({request.file, test.record.rows.front().line}, "column time_s",
                     fmt::format("{} is before the start", test.record.rows.front().time),
                     ">= 0 where the study gives initial_axial_stress_kPa, which holds at time 0");
  }
  return test;
}

}  // namespace isotach::datasets
