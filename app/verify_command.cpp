// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach verify: the law and its integration against references, closed forms and each other.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "reports/number.hpp"
#include "reports/terminal_progress.hpp"
#include "reports/verification_report.hpp"
#include "verification/random_path.hpp"

namespace isotach::app {

namespace {

/// Options of this command alone.
struct VerifyOptions {
  std::string sampling = "full";
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> random_path;
};

/// One random path again: its error, and the path as an element test.
int repeat_path(const CommonOptions& common, const VerifyOptions& options) {
  constexpr double kTolerance = 1e-6;
  const Run run("verify", {});
  reports::OutputDirectory output(common.out);
  const auto path = verification::random_path(options.seed, *options.random_path);
  const auto record = verification::examine(path, *options.random_path, kTolerance);
  const std::string file = fmt::format("path-{}-{}.toml", options.seed, *options.random_path);
  output.write_text(file, reports::element_toml(path));
  output.write_text("report.html", reports::random_path_report(run.info(), path, record, kTolerance).html());
  output.write_json("result.json", reports::result_json(run.info(), path, record, kTolerance));
  output.commit();
  if (common.quiet) return kDone;
  fmt::print("verify: {}: {}, error {} TOL of {:.0e} over a length of {} in {} substeps\n", path.name,
             verification::name(record.outcome), reports::format_number(record.error / kTolerance, 3),
             kTolerance, reports::format_number(record.length, 3), record.substeps);
  if (!record.message.empty()) fmt::print("verify: {}\n", record.message);
  fmt::print("element test: {}\n", (output.destination() / file).string());
  return kDone;
}

int verify(const CommonOptions& common, const VerifyOptions& options) {
  if (options.random_path) return repeat_path(common, options);
  const Run run("verify", {});
  reports::OutputDirectory output(common.out);
  reports::Progress progress("verify", common.quiet);
  verification::VerificationPlan plan;
  plan.sampling = options.sampling == "full" ? verification::Sampling::full : verification::Sampling::quick;
  plan.seed = options.seed;
  plan.threads = common.threads;
  plan.progress = [&progress](double share, std::string_view what) { progress.update(share, what); };
  plan.stop = &interrupted();
  const auto result = verification::verify(plan);
  if (!result) return end_failed(output, {}, "interrupted", true);
  progress.finish();
  output.write_text("report.html", reports::verification_report(run.info(), *result).html());
  reports::write_curves(output, *result);
  output.write_json("result.json", reports::result_json(run.info(), *result));
  const int exit_code = end_done(output, common.quiet);
  if (result->failed() == 0) return exit_code;
  fmt::print(stderr, "isotach: {} of {} checks failed; the report lists them\n", result->failed(),
             result->checks.size());
  return kNumericsFailed;
}

}  // namespace

Runner verify_command(CLI::App& line, CommonOptions& common) {
  const auto options = std::make_shared<VerifyOptions>();
  line.add_option("--sampling", options->sampling, "size of the random samples: 1000 or 100 000 paths")
      ->check(CLI::IsMember({"quick", "full"}))
      ->capture_default_str();
  line.add_option("--seed", options->seed, "seed of the random samples")->capture_default_str();
  line.add_option("--random-path", options->random_path,
                  "only this path of the random ones: its error, and the path as an element test");
  return [options, &common] { return verify(common, *options); };
}

}  // namespace isotach::app
