// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Compression curves, residuals and tables of an oedometer fit.
#include "reports/oedometer_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/time_axis.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;

constexpr double kBand = 2.0;  // noise standard deviations; 95 % of good residuals lie inside

std::vector<double> measured_kPa(const experiments::OedometerExperiment& test) {
  std::vector<double> values;
  for (const datasets::OedometerRow& row : test.rows()) values.push_back(1e-3 * row.axial_stress);
  return values;
}

/// The model's stress at the rows, from the residuals of ln(stress).
std::vector<double> fitted_kPa(const experiments::OedometerExperiment& test,
                               const std::vector<double>& residuals) {
  std::vector<double> values = measured_kPa(test);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= std::exp(residuals[i] * test.noise()[i]);
  return values;
}

Figure compression_figure(const calibration::TestSummary& summary,
                          const experiments::OedometerExperiment& test,
                          const std::vector<double>& residuals) {
  Figure figure;
  figure.title = title_of(summary);
  figure.caption = fmt::format(
      "{}: compression curve along the measured strain history. Dots: measured ({} readings); line: {}. Root "
      "mean "
      "square of the residuals: {} times the noise.",
      title_of(summary), summary.values, summary.held_out ? "predicted, not fitted" : "fitted",
      format_number(summary.rms_over_noise, 3));
  figure.x = {.label = "axial effective stress (kPa)", .logarithmic = true};
  figure.y = {.label = "void ratio"};
  figure.height_to_width = 0.5;
  figure.series = {{.label = summary.held_out ? "predicted" : "fitted",
                    .x = fitted_kPa(test, residuals),
                    .y = test.void_ratios(),
                    .colour = palette_colour(1)},
                   {.label = "measured",
                    .style = SeriesStyle::dots,
                    .x = measured_kPa(test),
                    .y = test.void_ratios(),
                    .colour = palette_colour(0)}};
  return figure;
}

Figure residual_figure(Axis x, std::vector<double> at, const std::vector<double>& residuals,
                       std::string caption) {
  Figure figure;
  figure.caption = std::move(caption);
  figure.x = std::move(x);
  figure.y = {.label = "residual / noise"};
  double largest = 1.5 * kBand;
  for (const double residual : residuals) largest = std::max(largest, 1.05 * std::abs(residual));
  figure.y.min = -largest;
  figure.y.max = largest;
  figure.height_to_width = 0.7;
  figure.series = {{.style = SeriesStyle::dots, .x = std::move(at), .y = residuals, .in_legend = false}};
  figure.markers = {{MarkerLine::Direction::horizontal, kBand, ""},
                    {MarkerLine::Direction::horizontal, -kBand, ""}};
  return figure;
}

void add_curves(Page& page, const OedometerFit& fit) {
  page.paragraph(
      fmt::format("The model follows the measured strain history; its axial effective stress is compared "
                  "with the measured one. "
                  "A residual is ln(model stress) − ln(measured stress) over its noise, which adds up the "
                  "noise of stress and "
                  "that of strain times the slope of the stage. Were the model right, 95 % of the residuals "
                  "would lie between "
                  "the lines at ±{:.0f}, without pattern.",
                  kBand));
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) {
    const experiments::OedometerExperiment& test = *fit.experiments[i];
    const calibration::TestSummary& summary = fit.result.tests[i];
    const std::vector<double>& residuals = fit.evaluation.scaled_residuals[i];
    page.figure(compression_figure(summary, test, residuals));
    const TimeUnit unit = time_unit_for(test.rows().back().time);
    std::vector<double> times;
    for (const datasets::OedometerRow& row : test.rows()) times.push_back(row.time / unit.seconds);
    page.figures(
        residual_figure({.label = fmt::format("time ({})", unit.name)}, std::move(times), residuals,
                        summary.name + ": residuals against time."),
        residual_figure({.label = "axial effective stress (kPa)", .logarithmic = true}, measured_kPa(test),
                        residuals, summary.name + ": residuals against stress."));
  }
}

Table test_table(const datasets::Study& study, const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Oedometer tests.",
              .header = {"Test", "Data", "Use", "Readings", "rms of ln stress", "rms / noise"},
              .alignment = {left, left, left, right, right, right}};
  for (std::size_t i = 0; i < fit.result.tests.size(); ++i) {
    const calibration::TestSummary& test = fit.result.tests[i];
    table.rows.push_back({test.name, data_name(fit.experiments[i]->test().record.file, study.file),
                          test.held_out ? "held out" : "fitted", fmt::format("{}", test.values),
                          format_number(test.rms, 3), format_number(test.rms_over_noise, 3)});
  }
  return table;
}

Table specimen_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Specimens, start and noise.",
              .header = {"Test", "H0 (mm)", "e0", "Start: axial stress (kPa)", "K0", "Noise of stress",
                         "floor (kPa)", "Noise of strain"},
              .alignment = {left, right, right, right, right, right, right, right}};
  std::vector<std::string> sources;
  for (const auto& experiment : fit.experiments) {
    const datasets::OedometerTest& test = experiment->test();
    table.rows.push_back(
        {test.name, format_number(1e3 * test.height), format_number(test.void_ratio, 5),
         format_number(1e-3 * experiment->start().axial_stress), format_number(test.initial_K0, 3),
         fmt::format("{} %", format_number(100.0 * test.noise.stress_relative, 2)),
         format_number(1e-3 * test.noise.stress_floor, 2), format_number(test.noise.strain, 2)});
    sources.push_back(fmt::format("{} {}", test.name, test.void_ratio_source));
  }
  table.notes = {fmt::format("Where e0 comes from: {}.", fmt::join(sources, "; "))};
  return table;
}

void add_gauge(Page& page, const OedometerFit& fit) {
  const calibration::FitResult& result = fit.result;
  const double e100 = result.parameters->e100();
  const double D_r = result.parameters->D_r();
  const double exponent = -1.0 / (result.parameters->lambda() * result.parameters->I_v());
  page.paragraph(
      fmt::format("e100 and D_r enter every prediction only through D_r (1+e100)^(−1/(λ I_v)), exactly: with "
                  "I_v, the initial "
                  "stress and the void ratio given they are one number, whatever the data. Here ln[D_r "
                  "(1+e100)^(−1/(λ I_v)) · "
                  "1 s] = {}. A factor f on D_r is undone by 1+e100 → (1+e100) f^(λ I_v); a start given by "
                  "an overconsolidation "
                  "ratio moves along, OCR0 → OCR0 f^I_v.",
                  format_number(std::log(D_r) + exponent * std::log1p(e100), 6)));
  page.paragraph(gauge_sentence(result));
  for (const std::string& sentence : null_direction_sentences(result)) page.box(Tone::warning, sentence);
}

void add_data_notes(Page& page, const datasets::Study& study, const OedometerFit& fit) {
  page.table(test_table(study, fit));
  page.table(specimen_table(fit));
  Table dropped{.caption = "Rows left out.",
                .header = {"Data", "Line", "What"},
                .alignment = {Alignment::left, Alignment::right, Alignment::left}};
  std::vector<std::string> notes;
  for (const auto& experiment : fit.experiments) {
    const datasets::OedometerRecord& record = experiment->test().record;
    const std::string data = data_name(record.file, study.file);
    for (const datasets::RowNote& note : record.notes) {
      dropped.rows.push_back({data, fmt::format("{}", note.line), note.what});
    }
    if (!record.unknown_columns.empty()) {
      notes.push_back(fmt::format("{}: columns not read: {}", data, listed(record.unknown_columns)));
    }
    if (record.stages_deduced) {
      notes.push_back(
          fmt::format("{}: no stage column, loading and unloading deduced from the strains (movement "
                      "below {} taken for noise)",
                      data, format_number(record.stage_threshold, 2)));
    }
  }
  if (dropped.rows.empty()) {
    page.paragraph("No row had to be mended or left out.");
  } else {
    page.table(std::move(dropped));
  }
  for (const std::string& text : assumptions_on(study.assumptions, "oedometer test")) notes.push_back(text);
  if (!notes.empty()) page.box(Tone::plain, "Taken for granted:\n" + bulleted(notes));
}

}  // namespace

void add_oedometer_verdicts(Page& page, const OedometerFit& fit) {
  const calibration::FitResult& result = fit.result;
  add_adequacy_verdict(page, result, "oedometer tests");
  if (!result.uncertainty.null_directions.empty()) page.verdict(Tone::bad, gauge_sentence(result));
  add_warnings(page, result.warnings);
}

void add_oedometer_section(Page& page, const datasets::Study& study, const OedometerFit& fit) {
  const calibration::FitResult& result = fit.result;
  page.section("Oedometer tests");
  add_curves(page, fit);
  if (Table correlation = correlation_table(result); !correlation.rows.empty()) {
    page.table(std::move(correlation));
  }
  page.paragraph(fmt::format(
      "Standard errors come from the exact Jacobian at the answer and the noise that the study states, "
      "times {} for misfit beyond that noise. They hold for this model and the parameters that were "
      "held fixed.",
      format_number(result.uncertainty.inflation, 3)));
  page.figure(cost_figure(result));
  page.table(route_table(result));
  add_gauge(page, fit);
  add_data_notes(page, study, fit);
}

Page oedometer_report(const RunInfo& run, const datasets::Study& study, const OedometerFit& fit) {
  const calibration::FitResult& result = fit.result;
  Page page("Oedometer fit", subtitle(run));
  add_oedometer_verdicts(page, fit);
  add_parameter_verdicts(page, result.estimates);
  add_warnings(page, run.warnings);
  add_data_note(page, study);
  page.fact("Gauge", gauge_sentence(result));
  if (result.check) {
    page.fact("Independent check", fmt::format("{} ends {} standard errors from {}", result.check->route,
                                               format_number(result.disagreement, 2), result.main.route));
  }
  std::size_t readings = 0;
  std::size_t left_out = 0;
  for (const auto& experiment : fit.experiments) {
    readings += experiment->rows().size();
    left_out += experiment->test().record.notes.size();
  }
  page.fact("Data", fmt::format("{} tests, {} readings compared, {} rows left out", fit.experiments.size(),
                                readings, left_out));
  page.table(parameter_table(result.estimates, "Parameters.", Meanings::shown));
  add_oedometer_section(page, study, fit);
  return page;
}

}  // namespace isotach::reports
