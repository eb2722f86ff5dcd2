// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "app/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "datasets/input_error.hpp"

namespace isotach::app {

datasets::ReadOptions CommonOptions::read_options() const {
  datasets::ReadOptions options;
  options.max_bytes = static_cast<std::uintmax_t>(max_file_megabytes * 1e6);
  return options;
}

Run::Run(std::string command, const std::filesystem::path& input)
    : info_{std::move(command), ISOTACH_VERSION, input}, start_(std::chrono::steady_clock::now()) {}

reports::RunInfo Run::info() const {
  reports::RunInfo info = info_;
  info.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return info;
}

int guarded(const std::function<int()>& body) {
  try {
    return body();
  } catch (const datasets::InputError& error) {
    fmt::print(stderr, "isotach: {}\n", error.what());
    return kBadInput;
  } catch (const reports::OutputError& error) {
    fmt::print(stderr, "isotach: {}\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "isotach: {}\n", error.what());
    return kNumericsFailed;
  }
}

CLI::Validator number_between(double least, double greatest) {
  const std::string accepted = fmt::format("{} to {}", least, greatest);
  return {[=](const std::string& text) {
            double value = 0.0;
            const bool inside = CLI::detail::lexical_cast(text, value) && value >= least && value <= greatest;
            return inside ? std::string() : fmt::format("{} is not accepted; accepted: {}", text, accepted);
          },
          accepted};
}

void add_input(CLI::App& line, CommonOptions& common, const char* what) {
  line.add_option(what, common.input, "a TOML file")->required();
  add_file_limit(line, common);
}

void add_file_limit(CLI::App& line, CommonOptions& common) {
  line.add_option("--max-file-mb", common.max_file_megabytes, "largest input file accepted, in MB")
      ->check(number_between(1e-6, 1e6))
      ->capture_default_str();
}

int end_failed(reports::OutputDirectory& output, const nlohmann::ordered_json& result,
               const std::string& message, bool interrupted) {
  if (interrupted) {
    fmt::print(stderr, "isotach: interrupted; nothing was written\n");
    return kInterrupted;
  }
  output.write_json("result.json", result);
  output.commit();
  fmt::print(stderr, "isotach: {}\n", message);
  return kNumericsFailed;
}

int end_done(reports::OutputDirectory& output, bool quiet) {
  output.commit();
  if (!quiet) fmt::print("report: {}\n", (output.destination() / "report.html").string());
  return kDone;
}

}  // namespace isotach::app
