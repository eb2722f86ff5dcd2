// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The command line.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "app/command.hpp"
#include "app/interrupt.hpp"

namespace {

using isotach::app::CommonOptions;

struct Command {
  const char* name;
  const char* input;
  const char* description;
  int (*run)(const CommonOptions&);
};

constexpr Command kCommands[] = {
    {"calibrate", "STUDY", "the main job: fit-oedometer, fit-slump, and again until both stand still",
     isotach::app::calibrate},
    {"fit-oedometer", "STUDY", "e100, lambda, kappa, D_r (and more, as the study says) from oedometer tests",
     isotach::app::fit_oedometer},
    {"fit-slump", "STUDY", "I_v and C_1 (as the study says) from measured slump outlines",
     isotach::app::fit_slump},
    {"slump", "TEST", "one slump test by the material point method", isotach::app::slump},
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"isotach: verification and calibration of the visco-hypoplastic model of soft clays and muds"};
  app.set_version_flag("--version", ISOTACH_VERSION);
  app.require_subcommand(1);
  CommonOptions options;
  options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (const Command& command : kCommands) {
    CLI::App* sub = app.add_subcommand(command.name, command.description);
    sub->add_option(command.input, options.input, "a TOML file")->required();
    sub->add_option("--out", options.out, "folder for the results, created with its parents")
        ->capture_default_str();
    sub->add_option("--threads", options.threads, "simulations run at once")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    sub->add_flag("--quiet", options.quiet, "no progress, no message but errors");
    sub->add_option("--max-file-mb", options.max_file_megabytes, "largest input file accepted, in MB")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? isotach::app::kDone : isotach::app::kBadInput;
  }
  isotach::app::watch_interrupts();
  for (const Command& command : kCommands) {
    if (app.got_subcommand(command.name)) {
      return isotach::app::guarded([&] { return command.run(options); });
    }
  }
  return isotach::app::kBadInput;
}
