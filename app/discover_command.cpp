// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach discover: does the model suffice, and if not, what is missing?
#include <algorithm>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "datasets/input_error.hpp"
#include "datasets/study.hpp"
#include "discovery/discover.hpp"
#include "reports/curves_csv.hpp"
#include "reports/discovery_report.hpp"
#include "reports/parameters_toml.hpp"
#include "reports/result_json.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

int discover(const CommonOptions& options) {
  const Run run("discover", options.input);
  const datasets::Study study = datasets::read_study(options.input, options.read_options());
  if (std::all_of(study.oedometer_tests.begin(), study.oedometer_tests.end(),
                  [](const auto& test) { return test.hold_out; })) {
    throw datasets::InputError(datasets::FilePlace{study.file}, "[[oedometer]]", "none that is not held out",
                               "at least one test to fit");
  }
  reports::OutputDirectory output(options.out);
  reports::Progress progress("discover", options.quiet);
  discovery::DiscoverOptions discover_options;
  discover_options.threads = options.threads;
  discover_options.control.stop = &interrupted();
  discover_options.progress = [&](double fraction, const std::string& what) {
    progress.update(fraction, what);
  };
  const auto found = discovery::discover_oedometer(study, discover_options);
  const reports::RunInfo info = run.info();
  if (!found) {
    return end_failed(output, reports::failure_json(info, found.error()), found.error().message,
                      found.error().interrupted);
  }
  progress.finish();
  const discovery::Candidate& answer =
      found->chosen ? found->trials[*found->chosen].candidate : found->base.candidate;
  output.write_text("report.html", reports::discovery_report(info, study, *found).html());
  output.write_text("parameters.toml", reports::parameters_toml(info, answer.fit));
  reports::write_curves(output, answer.fit);
  output.write_json("result.json", reports::result_json(info, study, *found));
  return end_done(output, options.quiet);
}

}  // namespace

Runner discover_command(CLI::App& line, CommonOptions& common) {
  add_input(line, common, "STUDY");
  return [&common] { return discover(common); };
}

}  // namespace isotach::app
