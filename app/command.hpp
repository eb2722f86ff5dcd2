// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What all commands share: options, exit codes, and how a run ends.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "datasets/text_file.hpp"
#include "reports/output_directory.hpp"
#include "reports/run_info.hpp"

namespace isotach::app {

enum ExitCode { kDone = 0, kBadInput = 2, kNumericsFailed = 3, kInterrupted = 130 };

/// Options of every command.
struct CommonOptions {
  std::filesystem::path input;
  std::filesystem::path out = "isotach-out";
  int threads = 1;
  bool quiet = false;
  double max_file_megabytes = 100.0;

  [[nodiscard]] datasets::ReadOptions read_options() const;
};

/// Clock and head of a run.
class Run {
 public:
  Run(std::string command, const std::filesystem::path& input);
  /// The head, with the seconds so far.
  [[nodiscard]] reports::RunInfo info() const;

 private:
  reports::RunInfo info_;
  std::chrono::steady_clock::time_point start_;
};

/// Calls `body` and turns exceptions into messages on stderr and exit codes: errors of input and of the
/// output folder 2, anything else 3.
[[nodiscard]] int guarded(const std::function<int()>& body);

/// Ends a run that failed: interrupted, it leaves nothing behind and returns 130; else it publishes `result`
/// as result.json and returns 3.
[[nodiscard]] int end_failed(reports::OutputDirectory& output, const nlohmann::ordered_json& result,
                             const std::string& message, bool interrupted);

/// Publishes the results and says where the report is.
[[nodiscard]] int end_done(reports::OutputDirectory& output, bool quiet);

// The commands; each returns an exit code.
[[nodiscard]] int fit_oedometer(const CommonOptions& options);
[[nodiscard]] int fit_slump(const CommonOptions& options);
[[nodiscard]] int calibrate(const CommonOptions& options);
[[nodiscard]] int slump(const CommonOptions& options);

}  // namespace isotach::app
