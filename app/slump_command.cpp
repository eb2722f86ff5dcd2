// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach slump: one simulated slump test, or several side by side.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>
#include <numeric>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "calibration/parallel.hpp"
#include "datasets/slump_file.hpp"
#include "mpm/slump.hpp"
#include "reports/curves_csv.hpp"
#include "reports/field_animation.hpp"
#include "reports/field_csv.hpp"
#include "reports/file_stems.hpp"
#include "reports/particles_vtu.hpp"
#include "reports/result_json.hpp"
#include "reports/slump_comparison.hpp"
#include "reports/slump_report.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

constexpr std::size_t kFrames = 60;  // of the animation

/// What a run does besides: its state is kept in `<out><suffix>.checkpoint` while it lasts.
mpm::RunOptions run_options_of(const CommonOptions& options, const std::string& suffix) {
  mpm::RunOptions run;
  run.stop = &interrupted();
  run.checkpoint = options.out;
  run.checkpoint += suffix + ".checkpoint";
  return run;
}

int slump(const CommonOptions& options) {
  const Run run("slump", options.input);
  const datasets::SlumpFile test = datasets::read_slump_file(options.input, options.read_options());
  reports::OutputDirectory output(options.out);
  reports::Progress progress("slump", options.quiet);
  mpm::RunOptions run_options = run_options_of(options, "");
  run_options.snapshots = true;
  run_options.frames = kFrames;
  run_options.progress = [&](double time, double done) {
    progress.update(done, fmt::format("t = {:.3f} s", time));
  };
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

/// Several slumps, one a thread.
class Comparison {
 public:
  Comparison(const CommonOptions& options, const std::vector<std::filesystem::path>& files)
      : options_(options), progress_("slumps", options.quiet), done_(files.size(), 0.0) {
    reports::FileStems stems;
    for (const std::filesystem::path& file : files) {
      slumps_.push_back({stems.of(file.stem().string()),
                         datasets::read_slump_file(file, options.read_options()),
                         tl::unexpected(mpm::SlumpFailure{})});
    }
  }

  void run() {
    calibration::parallel_for(slumps_.size(), options_.threads, [this](std::size_t k) {
      reports::ComparedSlump& slump = slumps_[k];
      mpm::RunOptions run = run_options_of(options_, "." + slump.name);
      run.progress = [this, k](double, double done) { tell(k, done); };
      slump.result = mpm::run_slump(slump.test.material, slump.test.setup, run);
      tell(k, 1.0);
    });
    progress_.finish();
  }
  [[nodiscard]] std::span<const reports::ComparedSlump> slumps() const { return slumps_; }

 private:
  void tell(std::size_t k, double done) {
    const std::lock_guard lock(mutex_);
    done_[k] = done;
    const auto ended = std::count(done_.begin(), done_.end(), 1.0);
    progress_.update(std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>(done_.size()),
                     fmt::format("{} of {} ended", ended, done_.size()));
  }

  const CommonOptions& options_;
  reports::Progress progress_;
  std::mutex mutex_;
  std::vector<double> done_;
  std::vector<reports::ComparedSlump> slumps_;
};

int compare(const CommonOptions& options, const std::vector<std::filesystem::path>& files) {
  const Run run("slump", files.front());
  Comparison comparison(options, files);
  reports::OutputDirectory output(options.out);
  comparison.run();
  const auto slumps = comparison.slumps();
  const auto failure = std::find_if(slumps.begin(), slumps.end(), [](const auto& s) { return !s.result; });
  const bool failed = failure != slumps.end();
  const bool none = std::none_of(slumps.begin(), slumps.end(), [](const auto& s) { return !!s.result; });
  if (interrupted() || none) {
    return end_failed(output, reports::result_json(run.info(), slumps), failure->result.error().message,
                      interrupted());
  }
  output.write_text("report.html", reports::slump_comparison_report(run.info(), slumps).html());
  for (const reports::ComparedSlump& slump : slumps) {
    if (slump.result) reports::write_curves(output, *slump.result, slump.name + "/");
  }
  output.write_json("result.json", reports::result_json(run.info(), slumps));
  const int code = end_done(output, options.quiet);
  if (!failed) return code;
  fmt::print(stderr, "isotach: {}: {}\n", failure->name, failure->result.error().message);
  return kNumericsFailed;
}

}  // namespace

Runner slump_command(CLI::App& line, CommonOptions& common) {
  const auto files = std::make_shared<std::vector<std::filesystem::path>>();
  line.add_option("TEST", *files, "TOML files; several are compared")->required();
  add_file_limit(line, common);
  return [&common, files] {
    if (files->size() > 1) return compare(common, *files);
    common.input = files->front();
    return slump(common);
  };
}

}  // namespace isotach::app
