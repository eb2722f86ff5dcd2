// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Slump simulations by way of the journal: looked up, else simulated under a limit of time, and kept.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <tl/expected.hpp>

#include "journal/journal.hpp"
#include "journal/simulation.hpp"

namespace isotach::journal {

struct RunnerOptions {
  RunLimits limits = {};       ///< of each simulation
  Execute execute = simulate;  ///< runs what the journal does not hold
};

/// Runs simulations from any thread. What a run returns is the same whether the journal held it or not, and
/// with any journal or none. A failure is returned, never thrown, exceptions from below included.
///
/// A run that timed out is taken from the journal as such unless the limit now is longer; then it is run
/// again. A run that did not time out is a result whatever it took.
///
/// A journal that fails on the way (a full disk) is not used any more: the fit goes on and trouble() says so.
class SlumpRunner {
 public:
  /// `journal` may be null: nothing is looked up or kept.
  explicit SlumpRunner(Journal* journal, RunnerOptions options = {});

  [[nodiscard]] tl::expected<mpm::SlumpResult, mpm::RunFailure> run(
      const std::string& test, const model::Parameters<double>& parameters, const mpm::SlumpSetup& setup);

  /// Runs that the journal held.
  [[nodiscard]] long reused() const { return reused_; }
  /// Runs simulated to their end, whatever it was.
  [[nodiscard]] long simulated() const { return simulated_; }
  /// Why the journal was given up; empty where it was not.
  [[nodiscard]] std::string trouble() const;

 private:
  [[nodiscard]] std::optional<Evaluation> look_up(const std::string& key);
  void keep(const Evaluation& evaluation);
  void give_up(const JournalError& error);

  std::atomic<Journal*> journal_;
  RunnerOptions options_;
  std::atomic<long> reused_{0};
  std::atomic<long> simulated_{0};
  mutable std::mutex mutex_;  // of trouble_
  std::string trouble_;
};

}  // namespace isotach::journal
