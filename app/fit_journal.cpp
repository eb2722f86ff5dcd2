// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "app/fit_journal.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "app/interrupt.hpp"
#include "cluster/ranks.hpp"
#include "datasets/slump_effects.hpp"
#include "mpm/code_version.hpp"

namespace isotach::app {

namespace {

std::filesystem::path file_of(const JournalLine& line, const CommonOptions& options) {
  if (!line.file.empty()) return line.file;
  // "out/" and "out" are one folder
  std::filesystem::path file = options.out.has_filename() ? options.out : options.out.parent_path();
  file += ".journal.sqlite";
  return file;
}

/// Keys of the study's slump tests, each once.
std::vector<std::string> setup_keys(const datasets::Study& study) {
  std::vector<std::string> keys;
  for (const datasets::SlumpTest& test : study.slump_tests) {
    keys.push_back(journal::Inputs(study.material, datasets::with_effects(test.setup, study.effects),
                                   mpm::code_version())
                       .setup_key);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

}  // namespace

void add_journal_options(CLI::App& line, JournalLine& journal) {
  auto* file =
      line.add_option("--journal", journal.file, "journal of simulations (default: OUT.journal.sqlite)");
  line.add_flag("--no-journal", journal.none, "keep no journal")->excludes(file);
  line.add_option("--time-limit", journal.time_limit, "wall time of one simulation, in s")
      ->check(number_between(1e-3, 1e9))
      ->capture_default_str();
}

FitJournal::FitJournal(const JournalLine& line, const CommonOptions& options, const datasets::Study& study) {
  if (!line.none) {
    journal_.emplace(file_of(line, options));
    if (!options.quiet) {
      fmt::print(stderr, "journal: {} holds {} simulations of this study's tests, {} in all\n",
                 journal_->file().string(), journal_->counts(setup_keys(study)).total(),
                 journal_->counts().total());
    }
  }
  journal::RunnerOptions runner_options;
  runner_options.limits = {line.time_limit, &interrupted()};
  if (options.ranks->size() > 1) {
    pool_.emplace(*options.ranks);
    runner_options.execute = [pool = &*pool_](const auto&... run) { return pool->run(run...); };
    if (!options.quiet) fmt::print(stderr, "simulations: one on each of {} processes\n", pool_->size());
  }
  runner_.emplace(journal_ ? &*journal_ : nullptr, runner_options);
}

experiments::Simulate FitJournal::simulate() {
  return [runner = &*runner_](const std::string& test, const model::Parameters<double>& parameters,
                              const mpm::SlumpSetup& setup) { return runner->run(test, parameters, setup); };
}

int FitJournal::at_once(int threads) const {
  return pool_ ? pool_->size() : threads;
}

void FitJournal::tell_rest(bool quiet) const {
  if (quiet || !journal_ || !warnings().empty()) return;
  fmt::print(stderr, "isotach: {} keeps the {} simulations that were done: give the same command again\n",
             journal_->file().string(), runner_->reused() + runner_->simulated());
}

std::vector<std::string> FitJournal::warnings() const {
  const std::string trouble = runner_->trouble();
  if (trouble.empty()) return {};
  return {trouble + "; simulations after that were not kept"};
}

}  // namespace isotach::app
