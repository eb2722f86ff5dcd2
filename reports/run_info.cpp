// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Names of files as reports show them: none depends on where the study lies.
#include "reports/run_info.hpp"

#include <fmt/format.h>

namespace isotach::reports {

std::string input_name(const std::filesystem::path& input) {
  const std::filesystem::path folder = input.lexically_normal().parent_path().filename();
  const bool says_something = !folder.empty() && folder != "." && folder != "..";
  return (says_something ? folder / input.filename() : input.filename()).generic_string();
}

std::string data_name(const std::filesystem::path& data, const std::filesystem::path& study) {
  const std::filesystem::path relative =
      data.lexically_normal().lexically_relative(study.lexically_normal().parent_path());
  if (relative.empty() || *relative.begin() == "..") return data.filename().generic_string();
  return relative.generic_string();
}

std::string subtitle(const RunInfo& run) {
  return fmt::format("isotach {} · version {} · {}", run.command, run.version, input_name(run.input));
}

}  // namespace isotach::reports
