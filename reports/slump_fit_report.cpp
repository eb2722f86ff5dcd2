// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines measured and simulated, and tables of a slump fit.
#include "reports/slump_fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/oedometer_summary.hpp"
#include "reports/slump_map_section.hpp"
#include "reports/slump_tables.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using calibration::SlumpComparison;
using calibration::SlumpFit;
using model::ParameterId;

constexpr std::size_t kOutlinesShown = 4;

std::string millimetres(double metres, int digits = 3) {
  return format_number(kMillimetres * metres, digits);
}

std::vector<NamedRun> runs_of(const SlumpFit& fit) {
  std::vector<NamedRun> runs;
  for (const SlumpComparison& comparison : fit.comparisons) {
    runs.push_back(
        {comparison.experiment->name(), comparison.experiment->test().best_setup(), &comparison.simulation});
  }
  return runs;
}

/// "38 ok, 2 timed out".
std::string status_list(const mpm::RunCounts& runs) {
  std::string list;
  for (std::size_t i = 0; i < mpm::kRunStatusCount; ++i) {
    const auto status = static_cast<mpm::RunStatus>(i);
    if (runs[status] == 0) continue;
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", runs[status], name_of(status));
  }
  return list;
}

Figure outline_figure(const calibration::TestSummary& summary, const SlumpComparison& comparison) {
  Figure figure = meridian_figure();
  figure.title = title_of(summary);
  figure.caption = fmt::format(
      "{}: outlines measured (dots) and simulated (lines); root mean square distance {} mm, "
      "from when the rim had left the mud {} mm.",
      title_of(summary), millimetres(comparison.rms), millimetres(comparison.rms_mould_gone));
  const std::vector<datasets::Outline>& outlines = comparison.experiment->test().outlines;
  std::size_t colour = 0;
  for (const std::size_t k : spread_indices(outlines.size(), kOutlinesShown)) {
    Series measured{.style = SeriesStyle::dots, .colour = palette_colour(colour), .in_legend = false};
    for (const datasets::OutlinePoint& point : outlines[k].points) {
      measured.x.push_back(kMillimetres * point.r);
      measured.y.push_back(kMillimetres * point.z);
    }
    Series simulated = outline_series(comparison.simulation.outlines[k], time_label(outlines[k].time));
    simulated.colour = palette_colour(colour++);
    figure.series.push_back(std::move(simulated));
    figure.series.push_back(std::move(measured));
  }
  return figure;
}

void add_outlines(Page& page, const SlumpFit& fit) {
  page.paragraph(
      "The distance of a measured point is the shortest one to the simulated outline of the same time, "
      "positive where the simulated mud reaches beyond the measured surface.");
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < fit.comparisons.size(); ++i) {
    figures.push_back(outline_figure(fit.result.tests[i], fit.comparisons[i]));
  }
  std::size_t i = 0;
  for (; i + 1 < figures.size(); i += 2) page.figures(std::move(figures[i]), std::move(figures[i + 1]));
  if (i < figures.size()) page.figure(std::move(figures[i]));
}

Table test_table(const datasets::Study& study, const SlumpFit& fit) {
  using enum Alignment;
  Table table{.caption = "Slump tests: root mean square distance between outlines.",
              .header = {"Test", "Data", "Use", "Points", "All times (mm)", "Rim gone (mm)", "Bias (mm)",
                         "Volume (%)", "rms / noise"},
              .alignment = {left, left, left, right, right, right, right, right, right}};
  for (std::size_t i = 0; i < fit.comparisons.size(); ++i) {
    const SlumpComparison& comparison = fit.comparisons[i];
    const calibration::TestSummary& summary = fit.result.tests[i];
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < comparison.distances.size(); ++k) {
      if (!comparison.experiment->mould_gone()[k]) continue;
      sum += comparison.distances[k];
      ++count;
    }
    table.rows.push_back({summary.name, data_name(comparison.experiment->test().data, study.file),
                          summary.held_out ? "held out" : "fitted", fmt::format("{}", summary.values),
                          millimetres(comparison.rms), millimetres(comparison.rms_mould_gone),
                          count == 0 ? kMissing : millimetres(sum / static_cast<double>(count), 2),
                          fmt::format("{:+.1f}", 100.0 * comparison.volume_excess),
                          format_number(summary.rms_over_noise, 3)});
  }
  table.notes = {fmt::format(
      "All tests together, from when the rim had left the mud: {} mm. Bias: mean signed distance "
      "from then on, positive "
      "where the simulated mud reaches too far. Volume: of the measured outlines above that of the mould's "
      "fill, mean over times. rms / noise: of what is fitted, mean distances on stretches, decorrelated.",
      millimetres(fit.rms_mould_gone))};
  return table;
}

/// By what factor the strength at a given rate of flow differs between two values of C_1.
double strength_ratio(double I_v, double C_1, double other_C_1) {
  return std::pow((1.0 - other_C_1) / (1.0 - C_1), I_v);
}

/// What a slump can say on C_1, with this fit's numbers.
std::string C_1_sentence(const SlumpFit& fit) {
  const calibration::ParameterEstimate& C_1 = estimate_of(fit.result, ParameterId::C_1);
  const double change = 1.0 - strength_ratio(fit.result.parameters->I_v(), C_1.ci95_lower, C_1.ci95_upper);
  return fmt::format(
      "In undrained flow at the critical state C_1 enters only as a factor (1 − C_1) on the rate, so "
      "strength at a "
      "given rate goes with (1 − C_1)^I_v: over the whole 95 % interval of C_1, {} to {}, it changes by {} "
      "%. What "
      "outlines say of C_1 beyond that they say of the way to the critical state, in the first second.",
      format_number(C_1.ci95_lower, 3), format_number(C_1.ci95_upper, 3), format_number(100.0 * change, 2));
}

std::string_view scheme_name(const mpm::Numerics& numerics) {
  return mpm::kSchemeNames[static_cast<std::size_t>(numerics.scheme)];
}

}  // namespace

void add_slump_fit_verdicts(Page& page, const SlumpFit& fit) {
  const calibration::FitResult& result = fit.result;
  add_adequacy_verdict(page, result, "slump tests");
  if (is_free(result, ParameterId::C_1)) page.verdict(Tone::plain, C_1_sentence(fit));
  add_warnings(page, result.warnings);
}

void add_slump_fit_facts(Page& page, const SlumpFit& fit) {
  const double cell_size = fit.comparisons.empty() ? 0.0 : fit.comparisons.front().simulation.cell_size;
  page.fact(
      "Distance between outlines",
      fmt::format("{} mm root mean square from when the rim had left the mud, all {} tests, held-out ones "
                  "included",
                  millimetres(fit.rms_mould_gone), fit.comparisons.size()));
  if (!fit.comparisons.empty() && fit.corrections.any()) {
    const mpm::Numerics& quick = fit.comparisons.front().experiment->test().setup.numerics;
    const mpm::Numerics& best = fit.comparisons.front().experiment->test().best_setup().numerics;
    page.fact(
        "Reference numerics",
        fmt::format("cells of {} mm, {} scheme: comparisons and figures are by these. What the fit "
                    "simulates, cells of {} mm, {} scheme, is corrected to them at the answer, by {} mm "
                    "root mean square ({} mm while lifting)",
                    millimetres(best.cell_size), scheme_name(best), millimetres(quick.cell_size),
                    scheme_name(quick), millimetres(fit.corrections.outline),
                    millimetres(fit.corrections.lifting)));
  }
  page.fact("Simulations", fmt::format("{} by the material point method, cells of {} mm: {}",
                                       fit.runs.total(), millimetres(cell_size), status_list(fit.runs)));
}

void add_slump_fit_section(Page& page, const datasets::Study& study, const SlumpFit& fit) {
  const calibration::FitResult& result = fit.result;
  page.section("Slump tests");
  add_outlines(page, fit);
  page.table(test_table(study, fit));
  add_where_it_fails(page, fit);
  add_slump_map(page, fit);

  if (Table correlation = correlation_table(result); !correlation.rows.empty())
    page.table(std::move(correlation));
  page.paragraph(
      fmt::format("What is fitted are mean distances on stretches of some 4 mm of each outline, decorrelated "
                  "by their covariance: "
                  "each point's own error, what the study says neighbours share, and the error of the "
                  "simulations. Standard errors "
                  "come from {}, times {} for misfit beyond that noise.",
                  fit.map ? "the surrogate" : "central differences between simulations",
                  format_number(result.uncertainty.inflation, 3)));
  add_simulation_error(page, fit.simulation_error);
  for (const std::string& sentence : null_direction_sentences(result)) page.box(Tone::warning, sentence);
  std::vector<Figure> figures{cost_figure(result)};
  for (std::size_t k = 0; k < result.coordinates.size(); ++k) figures.push_back(parameter_figure(result, k));
  std::size_t i = figures.size() % 2;
  if (i == 1) page.figure(std::move(figures.front()));
  for (; i + 1 < figures.size(); i += 2) page.figures(std::move(figures[i]), std::move(figures[i + 1]));
  std::vector<calibration::OptimiserResult> further = fit.other_routes;
  if (fit.map) further.insert(further.end(), fit.map->routes.begin(), fit.map->routes.end());
  page.table(route_table(result, further));

  const std::vector<NamedRun> runs = runs_of(fit);
  if (!runs.empty()) page.paragraph(numerics_text(runs.front()));
  page.table(start_table(runs));
  page.table(budget_table(runs));
  const auto assumptions = assumptions_on(study.assumptions, "slump test");
  if (!assumptions.empty()) page.box(Tone::plain, "Taken for granted:\n" + bulleted(assumptions));
}

Page slump_fit_report(const RunInfo& run, const datasets::Study& study, const SlumpFit& fit) {
  Page page("Slump fit", subtitle(run));
  add_slump_fit_verdicts(page, fit);
  add_parameter_verdicts(page, fit.result.estimates);
  add_warnings(page, run.warnings);
  add_data_note(page, study);
  add_slump_fit_facts(page, fit);
  page.table(parameter_table(fit.result.estimates, "Parameters.", Meanings::shown));
  if (!fit.result.local_estimates.empty()) page.table(start_estimate_table(fit.result));
  if (!fit.effects.empty()) page.table(effect_table(fit.effects));
  add_slump_fit_section(page, study, fit);
  return page;
}

}  // namespace isotach::reports
