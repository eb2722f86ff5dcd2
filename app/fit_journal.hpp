// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The journal of a command that fits slump tests: its options, and simulations that go by way of it, here or
// on other processes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "cluster/simulation_pool.hpp"
#include "datasets/study.hpp"
#include "experiments/slump_experiment.hpp"
#include "journal/slump_runner.hpp"

namespace isotach::app {

/// What the line says of the journal.
struct JournalLine {
  std::filesystem::path file;  ///< where empty, beside the results
  bool none = false;
  double time_limit = journal::RunLimits{}.time;  ///< s a simulation
};

/// Adds --journal, --no-journal and --time-limit.
void add_journal_options(CLI::App& line, JournalLine& journal);

/// An open journal and the simulations of one fit.
class FitJournal {
 public:
  /// Opens or makes the file of `line`, by default `<out>.journal.sqlite`, and says, unless quiet, how much
  /// it holds of this study.
  FitJournal(const JournalLine& line, const CommonOptions& options, const datasets::Study& study);

  /// For fits; this object must outlive them.
  [[nodiscard]] experiments::Simulate simulate();
  /// Simulations to ask for at once: `threads`, or one a process where several were started together.
  [[nodiscard]] int at_once(int threads) const;

  /// After an interrupt: says on stderr, unless quiet, that the fit can go on.
  void tell_rest(bool quiet) const;
  /// What a result must say of the journal: nothing where it served.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  std::optional<journal::Journal> journal_;
  std::optional<cluster::SimulationPool> pool_;
  std::optional<journal::SlumpRunner> runner_;
};

}  // namespace isotach::app
