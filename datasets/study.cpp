// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A study: implementation.
#include "datasets/study.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "datasets/effects_section.hpp"
#include "datasets/fit_settings.hpp"
#include "datasets/oedometer_section.hpp"
#include "datasets/study_sections.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {
namespace {

SlumpNoise read_slump_noise(TomlTable& test, Assumptions& assumptions) {
  SlumpNoise noise;
  std::optional<double> outline_mm;
  std::optional<double> lifting_mm;
  std::optional<double> shared_mm;
  constexpr double kSharedPart = 0.7;  // of the standard deviation: half of the variance
  if (auto table = test.table_if("noise")) {
    outline_mm = table->number_if("outline_mm", Range::positive(100.0));
    lifting_mm = table->number_if("lifting_mm", Range::positive(100.0));
    shared_mm =
        table->number_if("shared_mm", Range{0.0, outline_mm.value_or(1e3 * noise.outline), false, true});
    table->reject_unknown_keys();
  }
  if (outline_mm) noise.outline = 1e-3 * *outline_mm;
  if (lifting_mm) noise.lifting = 1e-3 * *lifting_mm;
  noise.shared = shared_mm ? 1e-3 * *shared_mm : kSharedPart * noise.outline;
  if (!shared_mm) {
    assumptions.add(
        fmt::format("error that an outline's points share not given, {:.3g} mm assumed", 1e3 * noise.shared));
  }
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
                          const ReadText& read_data) {
  SlumpTest test{};
  test.name = read_test_name(table, names);
  Assumptions assumptions("slump test " + test.name, study.assumptions);
  test.data = study.file.parent_path() / table.text("data");
  test.setup.mould = read_mould(table.table("mould"), assumptions);
  test.setup.mud = read_mud(table.table("mud"), assumptions);
  test.setup.base = read_base(table, assumptions);
  const StudyNumerics numerics = read_study_numerics(root);
  test.setup.numerics = numerics.own;
  test.reference = numerics.reference;
  check_cell_size(root, test.setup);
  check_cell_size(root, test.best_setup());
  check_slab(table, study.material, test.setup);
  test.noise = read_slump_noise(table, assumptions);
  test.hold_out = table.boolean_if("hold_out").value_or(false);
  table.reject_unknown_keys();
  test.outlines = parse_outlines(CsvTable::parse(read_data(test.data), test.data));
  for (const Outline& outline : test.outlines) test.setup.times.push_back(outline.time);
  return test;
}

}  // namespace

std::optional<double> stated_value(const mpm::Mud& mud, MudQuantity quantity) {
  return quantity == MudQuantity::void_ratio ? mud.void_ratio : mud.overconsolidation_ratio;
}

mpm::SlumpSetup SlumpTest::best_setup() const {
  mpm::SlumpSetup best = setup;
  if (reference) best.numerics = *reference;
  return best;
}

mpm::Mud with_values(mpm::Mud mud, const std::vector<FreeMud>& free, std::span<const double> values) {
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (free[k].quantity == MudQuantity::void_ratio) {
      mud.void_ratio = values[k];
    } else {
      mud.overconsolidation_ratio = values[k];
    }
  }
  return mud;
}

Study read_study(const std::filesystem::path& file, const ReadOptions& options) {
  const ReadText read = [&](const std::filesystem::path& path) { return read_text_file(path, options); };
  return parse_study(read(file), file, read);
}

Study parse_study(std::string text, const std::filesystem::path& file, const ReadText& read_data) {
  const TomlDocument document = TomlDocument::parse(std::move(text), file);
  TomlTable root = document.root();
  for (const std::string_view section : {"material", "fit", "oedometer", "slump", "numerics"}) {
    static_cast<void>(root.has(section));
  }
  static_cast<void>(root.has("effects"));
  std::string note;
  if (root.has("note")) note = root.text("note");
  root.reject_unknown_keys();

  Study study{file, std::move(note), read_material(root.table("material")), {}, {}, {}, {}, {}};
  study.effects = read_effects(root, study.material);
  study.fit = read_fit(root, study.material, study.effects);
  static_cast<void>(read_study_numerics(root));  // checked also where no slump test uses it
  std::set<std::string> names;
  for (TomlTable& test : root.tables("oedometer")) {
    const FilePlace place = test.place();
    study.oedometer_tests.push_back(read_oedometer_test(
        std::move(test), {study.file, study.material, names, read_data, study.assumptions}));
    check_effects(study.effects, study.oedometer_tests.back(), place);
  }
  for (TomlTable& test : root.tables("slump")) {
    const FilePlace place = test.place();
    study.slump_tests.push_back(read_slump_test(std::move(test), root, study, names, read_data));
    check_effects(study.effects, study.slump_tests.back().name, study.slump_tests.back().setup, place);
  }
  check_free_mud(study);
  if (names.empty()) {
    throw InputError({file}, "study", "it has no test", "at least one [[oedometer]] or [[slump]]");
  }
  return study;
}

}  // namespace isotach::datasets
