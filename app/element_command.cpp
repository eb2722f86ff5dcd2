// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach element: one element test.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "datasets/element_file.hpp"
#include "integrators/element_test.hpp"
#include "reports/element_report.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

using integrators::Method;

/// Options of this command alone.
struct ElementOptions {
  std::string integrator = std::string(integrators::name(Method::fellin_ostermann));
  std::optional<double> tolerance;  ///< relative; by default the integrator's own
};

/// The relative tolerance of the method that is to run.
double& relative_tolerance(integrators::Options& options) {
  switch (options.method) {
    case Method::cvode:
      return options.cvode.relative;
    case Method::rosenbrock:
      return options.rosenbrock.relative;
    case Method::fellin_ostermann:
      break;
  }
  return options.fellin_ostermann.relative;
}

reports::ElementRun run_stages(const datasets::ElementFile& test, const integrators::Options& options,
                               double tolerance, bool quiet) {
  double end = 0.0;
  for (const integrators::Stage& stage : test.stages) end += stage.increment.duration;
  reports::Progress progress("element", quiet);
  integrators::ElementWatch watch;
  watch.stop = &interrupted();
  watch.progress = [&](double time) { progress.update(time / end, fmt::format("t = {:.4g} s", time)); };
  auto rows = integrators::run_element_test(model::Law<double>(test.material), test.start, test.stages,
                                            options, watch);
  reports::ElementRun result{options.method, tolerance, {}};
  if (rows) {
    result.rows = *std::move(rows);
    progress.finish();
  } else {
    result.rows = std::move(rows.error().rows);
    result.failure = std::move(rows.error());
  }
  return result;
}

int element(const CommonOptions& common, const ElementOptions& options) {
  const Run run("element", common.input);
  const datasets::ElementFile test = datasets::read_element_file(common.input, common.read_options());
  reports::OutputDirectory output(common.out);
  integrators::Options integration;
  integration.method = integrators::find_method(options.integrator).value();
  double& tolerance = relative_tolerance(integration);
  tolerance = options.tolerance.value_or(tolerance);

  const reports::ElementRun result = run_stages(test, integration, tolerance, common.quiet);
  const bool stopped = result.failure && result.failure->interrupted;
  if (!stopped) {
    output.write_text("report.html", reports::element_report(run.info(), test, result).html());
    reports::write_curves(output, test, result);
  }
  const auto json = reports::result_json(run.info(), test, result);
  if (result.failure) return end_failed(output, json, reports::failure_text(test, result), stopped);
  output.write_json("result.json", json);
  if (!common.quiet) fmt::print("element: {}\n", reports::summary_text(test, result));
  return end_done(output, common.quiet);
}

}  // namespace

Runner element_command(CLI::App& line, CommonOptions& common) {
  add_input(line, common, "TEST");
  const auto options = std::make_shared<ElementOptions>();
  std::vector<std::string> names;
  for (const Method method : integrators::kMethods) names.emplace_back(integrators::name(method));
  line.add_option("--integrator", options->integrator, "how the law is integrated")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  line.add_option("--tolerance", options->tolerance,
                  "relative tolerance of the integrator (by default its own)")
      ->check(number_between(1e-13, 0.1));
  return [options, &common] { return element(common, *options); };
}

}  // namespace isotach::app
