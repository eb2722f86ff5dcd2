// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slump file: implementation.
#include "datasets/slump_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "datasets/effects_section.hpp"
#include "datasets/slump_effects.hpp"
#include "datasets/study_sections.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {
namespace {

std::vector<double> read_times(TomlTable output) {
  constexpr std::string_view kKey = "times_s";
  constexpr std::string_view kAccepted = "a list of increasing times > 0";
  const auto times = output.numbers_if(kKey, Range::positive(1e7), kAccepted);
  if (!times) throw output.error(kKey, "it is missing", kAccepted);
  if (times->empty()) throw output.error(kKey, "an empty list", kAccepted);
  for (std::size_t i = 1; i < times->size(); ++i) {
    if (!((*times)[i] > (*times)[i - 1])) {
      throw output.error(kKey, fmt::format("{} after {}", (*times)[i], (*times)[i - 1]), kAccepted);
    }
  }
  output.reject_unknown_keys();
  return *times;
}

}  // namespace

SlumpFile read_slump_file(const std::filesystem::path& file, const ReadOptions& options) {
  const TomlDocument document = TomlDocument::read(file, options);
  TomlTable root = document.root();
  for (const std::string_view section :
       {"material", "effects", "mud", "mould", "base", "numerics", "output"}) {
    static_cast<void>(root.has(section));
  }
  root.reject_unknown_keys();

  std::vector<std::string> texts;
  Assumptions assumptions("slump test", texts);
  auto material = read_material(root.table("material"));
  mpm::SlumpSetup setup;
  setup.mud = read_mud(root.table("mud"), assumptions);
  setup.mould = read_mould(root.table("mould"), assumptions);
  setup.base = read_base(root, assumptions);
  setup.numerics = read_numerics(root);
  check_cell_size(root, setup);
  check_slab(root, material, setup);
  setup.times = read_times(root.table("output"));
  auto effects = read_effects(root, material);
  check_effects(effects, "of the file", setup, root.place());
  setup = with_effects(std::move(setup), effects);
  return {file, std::move(material), std::move(setup), std::move(effects), std::move(texts)};
}

}  // namespace isotach::datasets
