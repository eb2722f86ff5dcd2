// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach next-test: what each test that could be made would add to a study.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command.hpp"
#include "app/fit_journal.hpp"
#include "app/interrupt.hpp"
#include "app/study_command.hpp"
#include "calibration/next_test.hpp"
#include "datasets/candidates.hpp"
#include "reports/next_test_report.hpp"
#include "reports/result_json.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

/// What the line says besides what all commands have.
struct NextTestLine {
  JournalLine journal;
  std::filesystem::path candidates;  ///< empty: the table that is built in
};

int next_test(const CommonOptions& options, const NextTestLine& line) {
  const Run run("next-test", options.input);
  const datasets::Study study = datasets::read_study(options.input, options.read_options());
  const datasets::Candidates candidates =
      line.candidates.empty() ? datasets::parse_candidates(std::string(datasets::default_candidates()),
                                                           "built-in candidates", study)
                              : datasets::read_candidates(line.candidates, study, options.read_options());
  reports::OutputDirectory output(options.out);
  FitJournal journal(line.journal, options, study);
  reports::Progress progress("next-test", options.quiet);
  calibration::NextTestOptions next_options;
  next_options.simulate = journal.simulate();
  next_options.threads = journal.at_once(options.threads);
  next_options.stop = &interrupted();
  next_options.progress = [&](double fraction, const std::string& what) { progress.update(fraction, what); };
  const auto next = calibration::rate_candidates(study, candidates, next_options);
  const reports::RunInfo info = info_of(run, journal);
  if (!next) return failed(output, info, next.error(), journal, options.quiet);
  progress.finish();
  output.write_text("report.html", reports::next_test_report(info, study, *next).html());
  if (line.candidates.empty()) output.write_text("candidates.toml", datasets::default_candidates());
  reports::write_curves(output, *next);
  output.write_json("result.json", reports::result_json(info, study, *next));
  return end_done(output, options.quiet);
}

}  // namespace

Runner next_test_command(CLI::App& line, CommonOptions& common) {
  add_input(line, common, "STUDY");
  const auto own = std::make_shared<NextTestLine>();
  line.add_option("--candidates", own->candidates,
                  "TOML file of the tests to rate (default: a table that is written to OUT/candidates.toml)");
  add_journal_options(line, own->journal);
  return [&common, own] { return next_test(common, *own); };
}

}  // namespace isotach::app
