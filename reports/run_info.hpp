// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What was run on what, for the head of result files and reports.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace isotach::reports {

/// One run of a command.
struct RunInfo {
  std::string command;                  ///< as typed: "fit-oedometer"
  std::string version;                  ///< of isotach
  std::filesystem::path input;          ///< the study or test file
  double seconds = 0.0;                 ///< wall clock so far; only result.json shows it
  std::vector<std::string> warnings{};  ///< besides those that the result itself holds
};

/// The file with its folder's name, "mud-a/study.toml": enough to recognise it, the same on every machine.
[[nodiscard]] std::string input_name(const std::filesystem::path& input);

/// The data file as the study names it where it lies in the study's folder or below, else its file name.
[[nodiscard]] std::string data_name(const std::filesystem::path& data, const std::filesystem::path& study);

/// Line below a report's title: command, version, input.
[[nodiscard]] std::string subtitle(const RunInfo& run);

}  // namespace isotach::reports
