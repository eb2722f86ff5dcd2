// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [[oedometer]] of a study: one oedometer test with its data.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "datasets/study.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {

/// What reading a test needs of the study around it.
struct StudyContext {
  const std::filesystem::path& file;  ///< of the study; data files are relative to its folder
  const model::Parameters<double>& material;
  std::set<std::string>& names;  ///< of the tests read so far; the test's is added
  const ReadText& read_data;
  std::vector<std::string>& assumptions;  ///< what is taken for granted is added
};

/// Reads one [[oedometer]] table; docs/files.md has its keys.
/// InputError: a key missing, unknown, out of range or without effect for that kind of data, and whatever the
/// readers of the data refuse.
[[nodiscard]] OedometerTest read_oedometer_test(TomlTable table, const StudyContext& study);

}  // namespace isotach::datasets
