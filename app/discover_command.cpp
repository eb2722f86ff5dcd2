// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach discover: does the model suffice, and if not, what is missing?
#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string_view>

#include "app/command.hpp"
#include "app/discover_study.hpp"
#include "app/fit_journal.hpp"
#include "app/interrupt.hpp"
#include "app/study_command.hpp"
#include "datasets/study.hpp"
#include "reports/curves_csv.hpp"
#include "reports/parameters_toml.hpp"
#include "reports/result_json.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

int discover(const CommonOptions& options, const JournalLine& journal_line, TestsLookedAt tests) {
  const Run run("discover", options.input);
  const datasets::Study study = datasets::read_study(options.input, options.read_options());
  const bool slumps = tests != TestsLookedAt::oedometer && fits_any(study.slump_tests);
  if (!slumps && (tests == TestsLookedAt::slump || !fits_any(study.oedometer_tests))) {
    constexpr std::array<std::string_view, 3> kSubjects{"[[oedometer]] and [[slump]]", "[[oedometer]]",
                                                        "[[slump]]"};
    refuse_without(study, std::string(kSubjects[static_cast<std::size_t>(tests)]));
  }
  reports::OutputDirectory output(options.out);
  FitJournal journal(slumps ? journal_line : JournalLine{{}, true}, options, study);
  reports::Progress progress("discover", options.quiet);
  const auto found = discover_study(
      study, {options.threads, journal.at_once(options.threads), journal.simulate(),
              [&](double fraction, const std::string& what) { progress.update(fraction, what); }, tests});
  const reports::RunInfo info = info_of(run, journal);
  if (!found) return failed(output, info, found.error(), journal, options.quiet);
  progress.finish();
  output.write_text("report.html", reports::discovery_report(info, study, *found).html());
  output.write_text("parameters.toml", reports::parameters_toml(info, *found));
  if (found->oedometer) reports::write_curves(output, found->oedometer->answer().candidate.fit);
  output.write_json("result.json", reports::result_json(info, study, *found));
  return end_done(output, options.quiet);
}

}  // namespace

Runner discover_command(CLI::App& line, CommonOptions& common) {
  add_input(line, common, "STUDY");
  const auto journal = std::make_shared<JournalLine>();
  add_journal_options(line, *journal);
  const auto only = std::make_shared<std::string>();
  line.add_option("--only", *only, "look at tests of one kind: oedometer (seconds) or slump (minutes)")
      ->check(CLI::IsMember({"oedometer", "slump"}));
  return [&common, journal, only] {
    const TestsLookedAt tests = only->empty()          ? TestsLookedAt::all
                                : *only == "oedometer" ? TestsLookedAt::oedometer
                                                       : TestsLookedAt::slump;
    return discover(common, *journal, tests);
  };
}

}  // namespace isotach::app
