// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach slump: one simulated slump test.
#include <fmt/format.h>

#include <filesystem>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "datasets/slump_file.hpp"
#include "mpm/slump.hpp"
#include "reports/curves_csv.hpp"
#include "reports/field_animation.hpp"
#include "reports/field_csv.hpp"
#include "reports/particles_vtu.hpp"
#include "reports/result_json.hpp"
#include "reports/slump_report.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

constexpr std::size_t kFrames = 60;  // of the animation

int slump(const CommonOptions& options) {
  const Run run("slump", options.input);
  const datasets::SlumpFile test = datasets::read_slump_file(options.input, options.read_options());
  reports::OutputDirectory output(options.out);
  reports::Progress progress("slump", options.quiet);
  mpm::RunOptions run_options;
  run_options.snapshots = true;
  run_options.frames = kFrames;
  run_options.stop = &interrupted();
  run_options.progress = [&](double time, double done) {
    progress.update(done, fmt::format("t = {:.3f} s", time));
  };
  run_options.checkpoint = options.out;
  run_options.checkpoint += ".checkpoint";
  mpm::SlumpSetup setup = test.setup;
  setup.numerics.threads = options.threads;
  const auto result = mpm::run_slump(test.material, setup, run_options);
  if (!result) {
    if (!options.quiet && std::filesystem::exists(run_options.checkpoint)) {
      fmt::print(stderr, "isotach: the run can go on from t = {:.3f} s: give the same command again\n",
                 result.error().time);
    }
    return end_failed(output, reports::failure_json(run.info(), result.error()), result.error().message,
                      result.error().kind == mpm::SlumpFailure::Kind::interrupted);
  }
  progress.finish();
  const reports::RunInfo info = run.info();
  output.write_text("report.html", reports::slump_report(info, test, *result).html());
  reports::write_curves(output, *result);
  reports::write_fields(output, result->fields);
  output.write_text(
      "animation.svg",
      reports::field_animation(reports::FieldQuantity::strain_rate_norm, result->frames, setup.mould).svg);
  reports::write_particles(output, result->snapshots);
  output.write_json("result.json", reports::result_json(run.info(), test, *result));
  return end_done(output, options.quiet);
}

}  // namespace

Runner slump_command(CLI::App& line, CommonOptions& common) {
  add_input(line, common, "TEST");
  return [&common] { return slump(common); };
}

}  // namespace isotach::app
