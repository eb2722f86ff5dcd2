// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "journal/slump_runner.hpp"

#include "mpm/code_version.hpp"

namespace isotach::journal {

SlumpRunner::SlumpRunner(Journal* journal, RunnerOptions options)
    : journal_(journal), options_(std::move(options)) {}

tl::expected<mpm::SlumpResult, mpm::RunFailure> SlumpRunner::run(const std::string& test,
                                                                 const model::Parameters<double>& parameters,
                                                                 const mpm::SlumpSetup& setup) {
  Inputs inputs(parameters, setup, mpm::code_version());
  std::optional<Evaluation> evaluation = look_up(inputs.key);
  if (evaluation) {
    ++reused_;
  } else {
    const RunLimits& limits = options_.limits;
    evaluation =
        Evaluation{options_.execute(parameters, setup, limits), std::move(inputs), test, limits.time};
    if (evaluation->status != mpm::RunStatus::interrupted) {
      ++simulated_;
      keep(*evaluation);
    }
  }
  if (evaluation->result) return std::move(*evaluation->result);
  return tl::unexpected(mpm::RunFailure{evaluation->status, evaluation->message});
}

std::string SlumpRunner::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

std::optional<Evaluation> SlumpRunner::look_up(const std::string& key) {
  Journal* journal = journal_;
  if (journal == nullptr) return std::nullopt;
  try {
    auto found = journal->get(key);
    if (found && found->status == mpm::RunStatus::timed_out && found->time_limit < options_.limits.time) {
      return std::nullopt;
    }
    return found;
  } catch (const JournalError& error) {
    give_up(error);
    return std::nullopt;
  }
}

void SlumpRunner::keep(const Evaluation& evaluation) {
  Journal* journal = journal_;
  if (journal == nullptr) return;
  try {
    journal->put(evaluation);
  } catch (const JournalError& error) {
    give_up(error);
  }
}

void SlumpRunner::give_up(const JournalError& error) {
  journal_ = nullptr;
  const std::lock_guard lock(mutex_);
  if (trouble_.empty()) trouble_ = error.what();
}

}  // namespace isotach::journal
