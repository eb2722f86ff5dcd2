// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The order of the report of an oedometer fit.
#include "reports/oedometer_report.hpp"

#include "reports/compression_figures.hpp"
#include "reports/fit_sections.hpp"
#include "reports/oedometer_data_section.hpp"
#include "reports/oedometer_summary.hpp"
#include "reports/oedometer_view.hpp"
#include "reports/residual_section.hpp"
#include "reports/robustness_section.hpp"
#include "reports/search_section.hpp"
#include "reports/start_section.hpp"
#include "reports/time_figures.hpp"
#include "reports/uncertainty_section.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;

void add_curves(Page& page, std::span<const TestView> views) {
  page.paragraph(
      "Where the apparatus imposed the strain, the model follows the measured strain history and its stress "
      "is "
      "compared; where it imposed the stress (load steps, holds), the model follows the stress and its "
      "strain "
      "is compared.");
  for (const TestView& view : views) {
    page.figure(void_ratio_figure(view));
    page.figure(strain_figure(view));
  }
}

/// Creep and relaxation of all tests, in their order.
std::vector<Figure> all_time_figures(std::span<const TestView> views) {
  std::vector<Figure> all;
  for (const TestView& view : views) {
    for (Figure& figure : time_figures(view)) all.push_back(std::move(figure));
  }
  return all;
}

/// Those that a reader in a hurry needs: not what is left at zero.
std::vector<calibration::ParameterEstimate> used_parameters(const calibration::FitResult& result) {
  std::vector<calibration::ParameterEstimate> used;
  for (const calibration::ParameterEstimate& estimate : result.estimates) {
    const bool absent = model::info(estimate.id).optional && estimate.value == 0.0 &&
                        estimate.verdict == calibration::Verdict::fixed;
    if (!absent) used.push_back(estimate);
  }
  return used;
}

void add_sections(Page& page, const datasets::Study& study, const OedometerFit& fit,
                  std::span<const TestView> views, std::string_view prefix) {
  const auto section = [&](std::string_view heading) {
    std::string text = std::string(prefix) + std::string(heading);
    page.section(std::move(text));
  };
  section("Compression curves");
  add_curves(page, views);
  if (std::vector<Figure> figures = all_time_figures(views); !figures.empty()) {
    section("Creep and relaxation");
    page.figures(std::move(figures));
  }
  section("Start values");
  add_start_values(page, fit, views);
  section("Residuals and noise");
  add_residuals(page, fit, views);
  section("Uncertainty");
  add_uncertainty(page, fit);
  section("Search");
  add_search(page, fit);
  if (fit.assessment) {
    section("Robustness");
    add_robustness(page, fit);
  }
  section("Data and assumptions");
  add_oedometer_data(page, study, fit);
  section("Definitions");
  add_oedometer_definitions(page);
}

}  // namespace

void add_oedometer_sections(Page& page, const datasets::Study& study, const OedometerFit& fit,
                            std::string_view prefix) {
  const std::vector<TestView> views = views_of(fit);
  add_sections(page, study, fit, views, prefix);
}

Page oedometer_report(const RunInfo& run, const datasets::Study& study, const OedometerFit& fit) {
  const std::vector<TestView> views = views_of(fit);
  const calibration::FitResult& result = fit.result;
  Page page("Oedometer fit", subtitle(run));
  add_oedometer_verdicts(page, fit);
  add_parameter_verdicts(page, result.estimates);
  add_warnings(page, run.warnings);
  add_data_note(page, study);
  add_oedometer_facts(page, fit);
  page.table(parameter_table(used_parameters(result), "Parameters.", Meanings::left_out));
  if (Table effects = effect_table(fit.effects); !effects.rows.empty()) page.table(std::move(effects));
  if (Table starts = start_estimate_table(result); !starts.rows.empty()) page.table(std::move(starts));
  page.figure(overview_figure(views));
  add_sections(page, study, fit, views, {});
  return page;
}

}  // namespace isotach::reports
