// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What all commands share: how they stand on the command line, options, exit codes, and how a run ends.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "datasets/text_file.hpp"
#include "reports/output_directory.hpp"
#include "reports/run_info.hpp"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace isotach::cluster {
class Ranks;
}  // namespace isotach::cluster

namespace isotach::app {

enum ExitCode { kDone = 0, kBadInput = 2, kNumericsFailed = 3, kInterrupted = 130 };

/// Options of every command.
struct CommonOptions {
  std::filesystem::path input;
  std::filesystem::path out = "isotach-out";
  int threads = 1;
  bool quiet = false;
  double max_file_megabytes = 100.0;
  const cluster::Ranks* ranks = nullptr;  ///< the processes that slump simulations of fits are shared with

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

/// Runs a command with the options that its line gave; returns an exit code.
using Runner = std::function<int()>;

/// A command of the program.
struct Command {
  const char* name;
  const char* description;
  /// Adds the command's own options, its input file among them, to its line, and returns what runs it once
  /// the line has been read. `common` outlives both.
  Runner (*set_up)(CLI::App& line, CommonOptions& common);
};

/// Accepts numbers from `least` to `greatest`, and so, unlike CLI::Range, no NaN.
[[nodiscard]] CLI::Validator number_between(double least, double greatest);

/// The input file as a positional argument called `what`, and the limit of its size.
void add_input(CLI::App& line, CommonOptions& common, const char* what);
/// The limit of an input file's size alone.
void add_file_limit(CLI::App& line, CommonOptions& common);

// The commands.
[[nodiscard]] Runner calibrate_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner discover_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner element_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner fit_oedometer_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner fit_slump_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner next_test_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner profile_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner slump_command(CLI::App& line, CommonOptions& common);
[[nodiscard]] Runner verify_command(CLI::App& line, CommonOptions& common);

}  // namespace isotach::app
