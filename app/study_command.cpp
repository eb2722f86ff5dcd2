// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "app/study_command.hpp"

#include "datasets/input_error.hpp"
#include "reports/result_json.hpp"

namespace isotach::app {

void refuse_without(const datasets::Study& study, const std::string& kind) {
  throw datasets::InputError(datasets::FilePlace{study.file}, kind, "none that is not held out",
                             "at least one test to fit");
}

reports::RunInfo info_of(const Run& run, const FitJournal& journal) {
  reports::RunInfo info = run.info();
  info.warnings = journal.warnings();
  return info;
}

int failed(reports::OutputDirectory& output, const reports::RunInfo& info,
           const calibration::FitFailure& failure) {
  return end_failed(output, reports::failure_json(info, failure), failure.message, failure.interrupted);
}

int failed(reports::OutputDirectory& output, const reports::RunInfo& info,
           const calibration::FitFailure& failure, const FitJournal& journal, bool quiet) {
  if (failure.interrupted) journal.tell_rest(quiet);
  return failed(output, info, failure);
}

}  // namespace isotach::app
