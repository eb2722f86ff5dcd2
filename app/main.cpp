// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The command line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <thread>
#include <vector>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "cluster/ranks.hpp"
#include "cluster/serve.hpp"
#include "mpm/code_version.hpp"

namespace {

using isotach::app::Command;
using isotach::app::CommonOptions;
using isotach::app::Runner;

constexpr Command kCommands[] = {
    {"calibrate", "the main job: fit-oedometer, fit-slump, and again until both stand still",
     isotach::app::calibrate_command},
    {"discover", "does the model suffice for the oedometer tests, and what is missing if not",
     isotach::app::discover_command},
    {"element", "one element test: a material point led through stages of stress and strain",
     isotach::app::element_command},
    {"fit-oedometer", "e100, lambda, kappa, D_r (and more, as the study says) from oedometer tests",
     isotach::app::fit_oedometer_command},
    {"fit-slump", "I_v and C_1 (as the study says) from measured slump outlines",
     isotach::app::fit_slump_command},
    {"next-test", "what each test that could be made next would add to I_v and C_1",
     isotach::app::next_test_command},
    {"profile", "outlines of a slump from photographs or the frames of a video",
     isotach::app::profile_command},
    {"slump", "one slump test by the material point method", isotach::app::slump_command},
    {"verify", "the law and its integration against references, closed forms and each other",
     isotach::app::verify_command},
};

void add_common_options(CLI::App& line, CommonOptions& common) {
  line.add_option("--out", common.out, "folder for the results, created with its parents")
      ->capture_default_str();
  line.add_option("--threads", common.threads,
                  "simulations run at once (those of fits under mpirun: one a process)")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  line.add_flag("--quiet", common.quiet, "no progress, no message but errors");
}

/// The first argument where it would be a command and is none; the parser itself would not name it.
const char* unknown_command(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return nullptr;
  const std::string_view name = argv[1];
  const bool known = std::any_of(std::begin(kCommands), std::end(kCommands),
                                 [name](const Command& command) { return command.name == name; });
  return known ? nullptr : argv[1];
}

/// The command that the line asks for; its exit code.
int run_line(int argc, char** argv, const isotach::cluster::Ranks& ranks) {
  if (const char* name = unknown_command(argc, argv)) {
    std::vector<std::string_view> names;
    for (const Command& command : kCommands) names.emplace_back(command.name);
    fmt::print(stderr, "isotach: unknown command \"{}\"; accepted: {}\n", name, fmt::join(names, ", "));
    return isotach::app::kBadInput;
  }
  CLI::App app{"isotach: verification and calibration of the visco-hypoplastic model of soft clays and muds"};
  app.set_version_flag("--version", ISOTACH_VERSION);
  app.require_subcommand(1);
  CommonOptions common;
  common.ranks = &ranks;
  common.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<Runner> runners;
  for (const Command& command : kCommands) {
    CLI::App* line = app.add_subcommand(command.name, command.description);
    runners.push_back(command.set_up(*line, common));
    add_common_options(*line, common);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? isotach::app::kDone : isotach::app::kBadInput;
  }
  for (std::size_t i = 0; i < runners.size(); ++i) {
    if (app.got_subcommand(kCommands[i].name)) return isotach::app::guarded(runners[i]);
  }
  return isotach::app::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace isotach;
  try {
    const cluster::Ranks ranks(mpm::code_version());
    app::watch_interrupts();
    if (ranks.rank() > 0) return cluster::serve(ranks, app::interrupted());
    const int code = run_line(argc, argv, ranks);
    cluster::let_leave(ranks, code);
    return code;
  } catch (const cluster::LaunchError& error) {
    if (error.rank() == 0) fmt::print(stderr, "isotach: {}\n", error.what());
    return app::kBadInput;
  }
}
