// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "journal/slump_runner.hpp"

#include <chrono>
#include <exception>

#include "mpm/code_version.hpp"

namespace isotach::journal {

SlumpRunner::SlumpRunner(Journal* journal, const RunnerOptions& options)
    : journal_(journal), options_(options) {}

tl::expected<mpm::SlumpResult, mpm::RunFailure> SlumpRunner::run(const std::string& test,
                                                                 const model::Parameters<double>& parameters,
                                                                 const mpm::SlumpSetup& setup) {
  Inputs inputs(parameters, setup, mpm::code_version());
  std::optional<Evaluation> evaluation = look_up(inputs.key);
  if (evaluation) {
    ++reused_;
  } else {
    evaluation = simulate(parameters, setup);
    evaluation->inputs = std::move(inputs);
    evaluation->test = test;
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
    if (found && found->status == mpm::RunStatus::timed_out && found->time_limit < options_.time_limit) {
      return std::nullopt;
    }
    return found;
  } catch (const JournalError& error) {
    give_up(error);
    return std::nullopt;
  }
}

Evaluation SlumpRunner::simulate(const model::Parameters<double>& parameters,
                                 const mpm::SlumpSetup& setup) const {
  mpm::RunOptions options;
  options.stop = options_.stop;
  options.history = false;
  options.time_limit = options_.time_limit;
  Evaluation evaluation;
  evaluation.time_limit = options_.time_limit;
  const auto begin = std::chrono::steady_clock::now();
  try {
    auto result = mpm::run_slump(parameters, setup, options);
    if (result) {
      evaluation.status = mpm::status_of(*result);
      evaluation.result = std::move(*result);
    } else {
      evaluation.status = mpm::status_of(result.error());
      evaluation.message = std::move(result.error().message);
    }
  } catch (const std::exception& error) {  // memory, above all: the fit can go on elsewhere
    evaluation.status = mpm::RunStatus::crashed;
    evaluation.message = error.what();
  }
  evaluation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return evaluation;
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
