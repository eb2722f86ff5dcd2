// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach fit-oedometer, fit-slump and calibrate: from a study to parameters and a report.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"
#include "app/discover_study.hpp"
#include "app/fit_journal.hpp"
#include "app/interrupt.hpp"
#include "app/study_command.hpp"
#include "calibration/calibrate.hpp"
#include "datasets/input_error.hpp"
#include "datasets/study.hpp"
#include "reports/calibration_report.hpp"
#include "reports/curves_csv.hpp"
#include "reports/discovery_report.hpp"
#include "reports/oedometer_report.hpp"
#include "reports/parameters_toml.hpp"
#include "reports/result_json.hpp"
#include "reports/slump_discovery_report.hpp"
#include "reports/slump_fit_report.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

void require_parameters(const datasets::Study& study, const std::vector<model::ParameterId>& list,
                        const char* key) {
  if (list.empty()) {
    throw datasets::InputError(datasets::FilePlace{study.file}, key, "an empty list",
                               "at least one parameter to fit");
  }
}

/// With a gauge D_r follows from the others: alone it leaves nothing to fit.
void require_more_than_gauged(const datasets::Study& study) {
  const auto& list = study.fit.oedometer;
  const auto is_D_r = [](model::ParameterId id) { return id == model::ParameterId::D_r; };
  if (!study.fit.oedometer_effects.empty()) return;
  if (study.fit.gauge == datasets::Gauge::none || !std::all_of(list.begin(), list.end(), is_D_r)) return;
  throw datasets::InputError(datasets::FilePlace{study.file}, "[fit] oedometer",
                             "D_r alone, which the gauge sets",
                             "a parameter beside D_r, or gauge = \"none\"");
}

/// Everything a fit writes.
template <class Fit, class Report>
int publish(reports::OutputDirectory& output, const CommonOptions& options, const reports::RunInfo& info,
            const datasets::Study& study, const Fit& fit, Report&& report) {
  output.write_text("report.html", report(info, study, fit).html());
  output.write_text("parameters.toml", reports::parameters_toml(info, fit));
  reports::write_curves(output, fit);
  output.write_json("result.json", reports::result_json(info, study, fit));
  return end_done(output, options.quiet);
}

int fit_oedometer(const CommonOptions& options) {
  const Run run("fit-oedometer", options.input);
  const datasets::Study study = datasets::read_study(options.input, options.read_options());
  require_fitted(study, study.oedometer_tests, "[[oedometer]]");
  if (study.fit.oedometer_effects.empty()) require_parameters(study, study.fit.oedometer, "[fit] oedometer");
  require_more_than_gauged(study);
  reports::OutputDirectory output(options.out);
  reports::Progress progress("fit-oedometer", options.quiet);
  calibration::OedometerFitOptions fit_options;
  fit_options.threads = options.threads;
  fit_options.control.stop = &interrupted();
  fit_options.progress = [&](double fraction, const std::string& what) { progress.update(fraction, what); };
  fit_options.control.callback = [&](int evaluations, double cost) {
    constexpr double kSearch = 0.05;  // of the work; the assessment is the rest
    progress.update(kSearch, fmt::format("evaluation {}, cost {:.5g}", evaluations, cost));
  };
  const auto fit = calibration::fit_oedometer(study, study.material, study.fit.oedometer, fit_options);
  if (!fit) return failed(output, run.info(), fit.error());
  progress.finish();
  return publish(output, options, run.info(), study, *fit, reports::oedometer_report);
}

int fit_slump(const CommonOptions& options, const JournalLine& journal_line) {
  const Run run("fit-slump", options.input);
  const datasets::Study study = datasets::read_study(options.input, options.read_options());
  require_fitted(study, study.slump_tests, "[[slump]]");
  require_parameters(study, study.fit.slump, "[fit] slump");
  reports::OutputDirectory output(options.out);
  FitJournal journal(journal_line, options, study);
  reports::Progress progress("fit-slump", options.quiet);
  calibration::SlumpFitOptions fit_options;
  fit_options.simulate = journal.simulate();
  fit_options.threads = journal.at_once(options.threads);
  fit_options.control.stop = &interrupted();
  fit_options.seed = study.fit.seed;
  bool searching = true;  // after the search the callback hears of the map's simulations
  fit_options.stage = [&](calibration::SlumpFitStage stage) {
    searching = stage == calibration::SlumpFitStage::simulation_error;
    progress.update(searching ? 0.02 : 0.5, name_of(stage));
  };
  fit_options.control.callback = [&](int count, double cost) {
    if (searching) {  // a search usually ends within two thirds of the evaluations it may use
      const double expected = 0.67 * fit_options.max_evaluations;
      progress.update(std::min(0.5, 0.1 + 0.4 * count / expected),
                      fmt::format("evaluation {}, cost {:.5g}", count, cost));
    } else {
      const double expected = 20.0 * static_cast<double>(study.slump_tests.size());
      progress.update(std::min(0.95, 0.55 + 0.4 * count / expected),
                      fmt::format("map and profiles, {} simulations", count));
    }
  };
  const auto fit = calibration::fit_slump(study, study.material, fit_options);
  const reports::RunInfo info = info_of(run, journal);
  if (!fit) return failed(output, info, fit.error(), journal, options.quiet);
  progress.finish();
  return publish(output, options, info, study, *fit, reports::slump_fit_report);
}

int calibrate(const CommonOptions& options, const JournalLine& journal_line) {
  const Run run("calibrate", options.input);
  const datasets::Study study = datasets::read_study(options.input, options.read_options());
  require_fitted(study, study.oedometer_tests, "[[oedometer]]");
  require_fitted(study, study.slump_tests, "[[slump]]");
  if (study.fit.oedometer_effects.empty()) require_parameters(study, study.fit.oedometer, "[fit] oedometer");
  require_more_than_gauged(study);
  require_parameters(study, study.fit.slump, "[fit] slump");
  reports::OutputDirectory output(options.out);
  FitJournal journal(journal_line, options, study);
  reports::Progress progress("calibrate", options.quiet);
  calibration::CalibrateOptions calibrate_options;
  calibrate_options.simulate = journal.simulate();
  calibrate_options.threads = options.threads;
  calibrate_options.slump_threads = journal.at_once(options.threads);
  calibrate_options.stop = &interrupted();
  constexpr double kFits = 0.7;  // of the work; discovery is the rest
  calibrate_options.progress = [&](double fraction, const std::string& what) {
    progress.update(kFits * fraction, what);
  };
  const auto result = calibration::calibrate(study, calibrate_options);
  if (!result) return failed(output, info_of(run, journal), result.error(), journal, options.quiet);
  const auto found =
      discover_study(study, {options.threads, journal.at_once(options.threads), journal.simulate(),
                             [&](double fraction, const std::string& what) {
                               progress.update(kFits + (1.0 - kFits) * fraction, "discovery: " + what);
                             }});
  const reports::RunInfo info = info_of(run, journal);
  if (!found) return failed(output, info, found.error(), journal, options.quiet);
  progress.finish();
  reports::Page page = reports::calibration_report(info, study, *result);
  reports::add_discovery(page, *found->oedometer);
  reports::add_slump_discovery(page, *found->slump);
  output.write_text("report.html", page.html());
  output.write_text("parameters.toml", reports::parameters_toml(info, *result));
  reports::write_curves(output, *result);
  auto json = reports::result_json(info, study, *result);
  json["discover"] = {{"oedometer", reports::discovery_json(*found->oedometer)},
                      {"slump", reports::discovery_json(*found->slump)}};
  output.write_json("result.json", json);
  return end_done(output, options.quiet);
}

/// A command on a study that keeps a journal of its simulations.
Runner with_journal(CLI::App& line, CommonOptions& common,
                    int (*command)(const CommonOptions&, const JournalLine&)) {
  add_input(line, common, "STUDY");
  const auto journal = std::make_shared<JournalLine>();
  add_journal_options(line, *journal);
  return [&common, journal, command] { return command(common, *journal); };
}

}  // namespace

Runner fit_oedometer_command(CLI::App& line, CommonOptions& common) {
  add_input(line, common, "STUDY");
  return [&common] { return fit_oedometer(common); };
}

Runner fit_slump_command(CLI::App& line, CommonOptions& common) {
  return with_journal(line, common, fit_slump);
}

Runner calibrate_command(CLI::App& line, CommonOptions& common) {
  return with_journal(line, common, calibrate);
}

}  // namespace isotach::app
