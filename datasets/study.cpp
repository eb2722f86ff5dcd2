// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A study: implementation.
#include "datasets/study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "datasets/fit_settings.hpp"
#include "datasets/study_sections.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {
namespace {

constexpr double kWaterDensity = 1000.0;  // kg/m3

/// Specimens of an oedometer; what is larger is a mistake of unit.
constexpr Range kSpecimen_mm = Range::positive(1000.0);

/// The test's name, which must not occur twice: results are listed and files are named by it.
std::string read_name(TomlTable& test, std::set<std::string>& names) {
  std::string name = test.text("name");
  if (name.find_first_of("/\\\n\r\t") != std::string::npos) {
    throw test.error("name", fmt::format("\"{}\"", name), "a name without slashes, tabs and line breaks");
  }
  if (!names.insert(name).second) {
    throw test.error("name", fmt::format("\"{}\" occurs twice", name), "a name of its own for each test");
  }
  return name;
}

struct VoidRatio {
  double value;
  std::string source;
};

/// e0 from the one of void_ratio, water_content and dry_mass_g that the test states.
VoidRatio read_void_ratio(TomlTable& test, double height, const std::optional<double>& diameter,
                          Assumptions& assumptions) {
  constexpr std::string_view kOneOf = "one of void_ratio, water_content and dry_mass_g";
  const auto void_ratio = test.number_if("void_ratio", kVoidRatio);
  const auto water_content = test.number_if("water_content", Range::positive(40.0));
  const auto dry_mass_g = test.number_if("dry_mass_g", Range::positive(1e6));
  const auto given_specific_gravity = test.number_if("specific_gravity", kSpecificGravity);
  const int count =
      int{void_ratio.has_value()} + int{water_content.has_value()} + int{dry_mass_g.has_value()};
  if (count == 0) throw test.error("void_ratio", "it is missing", kOneOf);
  if (count > 1) {
    throw test.error(water_content ? "water_content" : "dry_mass_g", "the void ratio is stated twice",
                     kOneOf);
  }
  if (void_ratio) return {*void_ratio, "given"};

  if (!given_specific_gravity) {
    assumptions.add(fmt::format("specific gravity not given, {} assumed", kAssumedSpecificGravity));
  }
  const double specific_gravity = given_specific_gravity.value_or(kAssumedSpecificGravity);
  if (water_content) {
    return {*water_content * specific_gravity,
            fmt::format("water content {} times specific gravity {}, saturated", *water_content,
                        specific_gravity)};
  }
  if (!diameter) {
    throw test.error("diameter_mm", "it is missing",
                     kSpecimen_mm.words() + ", as the void ratio follows from a volume");
  }
  const double volume = 0.25 * std::numbers::pi * *diameter * *diameter * height;
  const double value = specific_gravity * kWaterDensity * volume / (1e-3 * *dry_mass_g) - 1.0;
  if (!kVoidRatio.contains(value)) {
    throw test.error(
        "dry_mass_g",
        fmt::format("{} g in {:.6g} cm3 means a void ratio of {:.4g}", *dry_mass_g, 1e6 * volume, value),
        fmt::format("a void ratio {}", kVoidRatio.words()));
  }
  return {value, fmt::format("dry mass {} g in {:.6g} cm3, specific gravity {}", *dry_mass_g, 1e6 * volume,
                             specific_gravity)};
}

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

OedometerTest read_oedometer_test(TomlTable table, Study& study, std::set<std::string>& names,
                                  const ReadOptions& options) {
  OedometerTest test{};
  test.name = read_name(table, names);
  Assumptions assumptions("oedometer test " + test.name, study.assumptions);
  const std::filesystem::path data = study.file.parent_path() / table.text("data");
  test.height = 1e-3 * table.number("height_mm", kSpecimen_mm);
  if (const auto diameter = table.number_if("diameter_mm", kSpecimen_mm)) test.diameter = 1e-3 * *diameter;
  VoidRatio void_ratio = read_void_ratio(table, test.height, test.diameter, assumptions);
  test.void_ratio = void_ratio.value;
  test.void_ratio_source = std::move(void_ratio.source);
  if (const auto K0 = table.number_if("initial_K0", {0.0, 3.0, true, true})) {
    test.initial_K0 = *K0;
  } else {
    test.initial_K0 = 1.0 - std::sin(study.material.phi_c());
    assumptions.add(
        fmt::format("initial K0 not given, 1 - sin(phi_c) = {:.4f} (Jaky) assumed", test.initial_K0));
  }
  if (const auto stress = table.number_if("initial_axial_stress_kPa", Range::positive(1e5))) {
    test.initial_axial_stress = 1e3 * *stress;
  }
  test.noise = read_oedometer_noise(table, assumptions);
  test.hold_out = table.boolean_if("hold_out").value_or(false);
  table.reject_unknown_keys();
  test.record = read_oedometer(data, {test.height, test.diameter}, options);
  if (test.initial_axial_stress && test.record.rows.front().time < 0.0) {
    throw InputError({data, test.record.rows.front().line}, "column time_s",
                     fmt::format("{} is before the start", test.record.rows.front().time),
                     ">= 0 where the study gives initial_axial_stress_kPa, which holds at time 0");
  }
  return test;
}

SlumpNoise read_slump_noise(TomlTable& test, Assumptions& assumptions) {
  SlumpNoise noise;
  std::optional<double> outline_mm;
  std::optional<double> lifting_mm;
  if (auto table = test.table_if("noise")) {
    outline_mm = table->number_if("outline_mm", Range::positive(100.0));
    lifting_mm = table->number_if("lifting_mm", Range::positive(100.0));
    table->reject_unknown_keys();
  }
  if (outline_mm) noise.outline = 1e-3 * *outline_mm;
  if (lifting_mm) noise.lifting = 1e-3 * *lifting_mm;
  if (!outline_mm) {
    assumptions.add(fmt::format("noise of outlines not given, {} mm assumed", 1e3 * noise.outline));
  }
  if (!lifting_mm) {
    assumptions.add(
        fmt::format("noise of outlines while lifting not given, {} mm assumed", 1e3 * noise.lifting));
  }
  return noise;
}

SlumpTest read_slump_test(TomlTable table, TomlTable& root, Study& study, std::set<std::string>& names,
                          const ReadOptions& options) {
  SlumpTest test{};
  test.name = read_name(table, names);
  Assumptions assumptions("slump test " + test.name, study.assumptions);
  test.data = study.file.parent_path() / table.text("data");
  test.setup.mould = read_mould(table.table("mould"), assumptions);
  test.setup.mud = read_mud(table.table("mud"), assumptions);
  test.setup.base = read_base(table, assumptions);
  test.setup.numerics = read_numerics(root);
  check_cell_size(root, test.setup);
  test.noise = read_slump_noise(table, assumptions);
  test.hold_out = table.boolean_if("hold_out").value_or(false);
  table.reject_unknown_keys();
  test.outlines = read_outlines(test.data, options);
  for (const Outline& outline : test.outlines) test.setup.times.push_back(outline.time);
  return test;
}

}  // namespace

Study read_study(const std::filesystem::path& file, const ReadOptions& options) {
  const TomlDocument document = TomlDocument::read(file, options);
  TomlTable root = document.root();
  for (const std::string_view section : {"material", "fit", "oedometer", "slump", "numerics"}) {
    static_cast<void>(root.has(section));
  }
  refuse_effects(root);
  std::string note;
  if (root.has("note")) note = root.text("note");
  root.reject_unknown_keys();

  Study study{file, std::move(note), read_material(root.table("material")), {}, {}, {}, {}};
  study.fit = read_fit(root, study.material);
  static_cast<void>(read_numerics(root));  // checked also where no slump test uses it
  std::set<std::string> names;
  for (TomlTable& test : root.tables("oedometer")) {
    study.oedometer_tests.push_back(read_oedometer_test(std::move(test), study, names, options));
  }
  for (TomlTable& test : root.tables("slump")) {
    study.slump_tests.push_back(read_slump_test(std::move(test), root, study, names, options));
  }
  if (names.empty()) {
    throw InputError({file}, "study", "it has no test", "at least one [[oedometer]] or [[slump]]");
  }
  return study;
}

}  // namespace isotach::datasets
