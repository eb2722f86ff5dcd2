// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What commands on a study share: tests they need, the head of their results, and how they fail.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "app/fit_journal.hpp"
#include "calibration/fit_result.hpp"
#include "datasets/study.hpp"

namespace isotach::app {

/// Whether a fit would use any of the tests.
template <class Test>
[[nodiscard]] bool fits_any(const std::vector<Test>& tests) {
  return std::any_of(tests.begin(), tests.end(), [](const Test& test) { return !test.hold_out; });
}

/// The error that a study has no test of that kind, "[[slump]]", to fit.
[[noreturn]] void refuse_without(const datasets::Study& study, const std::string& kind);

template <class Test>
void require_fitted(const datasets::Study& study, const std::vector<Test>& tests, const char* kind) {
  if (!fits_any(tests)) refuse_without(study, kind);
}

/// The head of a result, with what the journal has to say.
[[nodiscard]] reports::RunInfo info_of(const Run& run, const FitJournal& journal);

/// Ends a run whose fit failed.
[[nodiscard]] int failed(reports::OutputDirectory& output, const reports::RunInfo& info,
                         const calibration::FitFailure& failure);
/// The same of a fit that kept a journal.
[[nodiscard]] int failed(reports::OutputDirectory& output, const reports::RunInfo& info,
                         const calibration::FitFailure& failure, const FitJournal& journal, bool quiet);

}  // namespace isotach::app
