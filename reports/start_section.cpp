// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Constructions drawn on the data, and the values read.
#include "reports/start_section.hpp"

#include <fmt/format.h>

#include <cmath>

#include "calibration/oedometer_start.hpp"
#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/time_axis.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using calibration::BeckerYield;
using calibration::CasagrandeYield;
using calibration::Constructions;
using calibration::Line;
using calibration::StartValue;
using calibration::StartValues;
using calibration::TimeLine;

/// ln(1+e) is straight against ln stress, e bends: a few points make it smooth.
ConstructionLine polyline(std::string name, const Line& line, double from, double to) {
  constexpr int kPieces = 12;
  ConstructionLine result{std::move(name), {}, {}};
  for (int i = 0; i <= kPieces; ++i) {
    const double stress = from * std::pow(to / from, static_cast<double>(i) / kPieces);
    result.stress.push_back(kPerPascal * stress);
    result.void_ratio.push_back(std::expm1(line.at(stress)));
  }
  return result;
}

std::string kPa(double stress) {
  return fmt::format("{} kPa", format_number(kPerPascal * stress, 3));
}

/// What the figure's caption says of the two yield stresses.
std::string yield_text(const Constructions& drawn) {
  std::string text = drawn.casagrande
                         ? fmt::format("Casagrande: yield at {}", kPa(drawn.casagrande->yield_stress))
                         : "Casagrande's construction cannot be drawn: " + drawn.casagrande.error();
  text += drawn.becker ? fmt::format("; Becker: yield at {}.", kPa(drawn.becker->yield_stress))
                       : "; Becker's cannot be drawn: " + drawn.becker.error() + ".";
  return text;
}

Figure construction_figure(const TestView& view, const Constructions& drawn) {
  Figure figure;
  figure.title = title_of(view.summary);
  figure.x = {.label = "axial effective stress (kPa)", .logarithmic = true};
  figure.y = {.label = "void ratio"};
  figure.height_to_width = 0.5;
  CompressionCurve measured = measured_curve(view);
  figure.series.push_back({.label = "measured",
                           .style = view.stepwise() ? SeriesStyle::discs : SeriesStyle::dots,
                           .x = std::move(measured.stress),
                           .y = std::move(measured.void_ratio),
                           .colour = palette_colour(0)});
  std::string previous;
  std::size_t colour = 0;
  for (ConstructionLine& line : construction_lines(drawn)) {
    const bool again = line.name == previous;
    if (!again) ++colour;
    previous = line.name;
    const bool aid = line.name == "tangent" || line.name == "bisector";
    figure.series.push_back({.label = line.name,
                             .style = aid ? SeriesStyle::dashed : SeriesStyle::line,
                             .x = std::move(line.stress),
                             .y = std::move(line.void_ratio),
                             .colour = palette_colour(colour),
                             .in_legend = !again});
  }
  if (drawn.casagrande) {
    figure.markers.push_back(
        {MarkerLine::Direction::vertical, kPerPascal * drawn.casagrande->yield_stress, "yield (Casagrande)"});
  }
  figure.caption =
      fmt::format("{}: constructions on the compression curve. {}", view.summary.name, yield_text(drawn));
  if (!drawn.virgin) figure.caption += " No virgin line: " + drawn.virgin.error() + ".";
  return figure;
}

Figure becker_figure(const TestView& view, const BeckerYield& becker) {
  Figure figure;
  figure.caption = fmt::format("{}: Becker's work method. The work done on the soil bends at yield, {}.",
                               view.summary.name, kPa(becker.yield_stress));
  figure.x = {.label = "axial effective stress (kPa)"};
  figure.y = {.label = "work (kJ/m³)"};
  figure.height_to_width = 0.75;
  Series points{.label = "measured", .style = SeriesStyle::dots, .colour = palette_colour(0)};
  for (const calibration::WorkPoint& point : becker.points) {
    points.x.push_back(kPerPascal * point.stress);
    points.y.push_back(1e-3 * point.work);
  }
  if (becker.points.size() < 100) points.style = SeriesStyle::discs;
  figure.series.push_back(std::move(points));
  const auto add = [&](const char* name, const calibration::WorkLine& line, double from, double to,
                       std::size_t colour) {
    Series series{.label = name, .colour = palette_colour(colour)};
    for (const double stress : {from, to}) {
      series.x.push_back(kPerPascal * stress);
      series.y.push_back(1e-3 * (line.intercept + line.slope * stress));
    }
    figure.series.push_back(std::move(series));
  };
  add("before yield", becker.before, becker.before.from_stress, becker.yield_stress, 2);
  add("after yield", becker.after, becker.yield_stress, becker.after.to_stress, 1);
  figure.markers.push_back({MarkerLine::Direction::vertical, kPerPascal * becker.yield_stress, ""});
  return figure;
}

/// A line against the logarithm of time, on the readings it rests on.
Figure time_line_figure(const TestView& view, const TimeLine& line, bool relaxation) {
  const auto curve = calibration::compression_curve_of(view.experiment);
  const TimeUnit unit = time_unit_for(line.duration);
  Figure figure;
  figure.x = {.label = fmt::format("time since it began ({})", unit.name), .logarithmic = true};
  figure.y = relaxation ? Axis{.label = "axial effective stress (kPa)", .logarithmic = true}
                        : Axis{.label = "void ratio"};
  figure.height_to_width = 0.75;
  Series points{.label = "measured", .style = SeriesStyle::discs, .colour = palette_colour(0)};
  Series drawn{.label = "line", .colour = palette_colour(1)};
  for (std::size_t i = line.first; i < line.first + line.count && i < curve.size(); ++i) {
    const double since = curve[i].time - line.begin;
    if (!(since + line.offset > 0.0)) continue;
    const double value = line.intercept - line.slope * std::log(since + line.offset);
    points.x.push_back(since / unit.seconds);
    points.y.push_back(relaxation ? kPerPascal * curve[i].axial_stress : curve[i].void_ratio);
    drawn.x.push_back(since / unit.seconds);
    drawn.y.push_back(relaxation ? kPerPascal * std::exp(value) : std::expm1(value));
  }
  figure.series = {std::move(points), std::move(drawn)};
  figure.caption = relaxation
                       ? fmt::format("{}: relaxation, ln stress against ln time; slope = I_v = {}.",
                                     view.summary.name, format_number(line.slope, 3))
                       : fmt::format("{}: creep at {}, ln(1+e) against ln time; slope = λ I_v = {}.",
                                     view.summary.name, kPa(line.stress), format_number(line.slope, 3));
  return figure;
}

void add_test(Page& page, const TestView& view, const Constructions& drawn) {
  page.figure(construction_figure(view, drawn));
  std::vector<Figure> small;
  if (drawn.becker) small.push_back(becker_figure(view, *drawn.becker));
  for (const TimeLine& line : drawn.relaxation) small.push_back(time_line_figure(view, line, true));
  for (const TimeLine& line : drawn.creep) small.push_back(time_line_figure(view, line, false));
  page.figures(std::move(small));
}

Table rate_step_table(std::span<const TestView> views, const StartValues& start) {
  using enum Alignment;
  Table table{.caption = "Jumps of strain rate in virgin compression.",
              .header = {"Test", "Rate before (1/s)", "Rate after (1/s)", "Step of ln stress", "I_v"},
              .alignment = {left, right, right, right, right},
              .notes = {"I_v = step of ln stress at equal void ratio over ln(rate after/rate before)."}};
  std::size_t next = 0;
  for (const TestView& view : views) {
    if (view.summary.held_out || next >= start.tests.size()) continue;
    for (const calibration::RateStep& step : start.tests[next].rate_steps) {
      table.rows.push_back({view.summary.name, format_number(step.rate_before, 3),
                            format_number(step.rate_after, 3), format_number(step.logarithmic_step, 3),
                            format_number(step.I_v, 3)});
    }
    ++next;
  }
  return table;
}

Table value_table(const calibration::OedometerFit& fit) {
  using enum Alignment;
  using model::ParameterId;
  Table table{.caption = "Start values read off the constructions, and what the fit made of them.",
              .header = {"Parameter", "Read", "Fitted", "Where from"},
              .alignment = {left, right, right, left}};
  const StartValues& start = *fit.start;
  const std::pair<ParameterId, const StartValue&> values[] = {{ParameterId::e100, start.e100},
                                                              {ParameterId::lambda, start.lambda},
                                                              {ParameterId::kappa, start.kappa},
                                                              {ParameterId::I_v, start.I_v}};
  for (const auto& [id, value] : values) {
    const bool moved = is_free(fit.result, id);
    table.rows.push_back({std::string(model::info(id).name),
                          value.value ? format_number(*value.value, 3) : std::string(kMissing),
                          format_number(estimate_of(fit.result, id).value, 4) + (moved ? "" : " (fixed)"),
                          value.source});
  }
  return table;
}

}  // namespace

std::vector<ConstructionLine> construction_lines(const Constructions& drawn) {
  std::vector<ConstructionLine> lines;
  const double yield = drawn.casagrande ? drawn.casagrande->yield_stress : HUGE_VAL;
  if (drawn.virgin) {
    const Line& line = drawn.virgin->line;
    lines.push_back(polyline("virgin line", line, std::min(line.from_stress, yield), line.to_stress));
  }
  for (const Line& line : drawn.swelling) {
    lines.push_back(polyline("swelling line", line, line.from_stress, line.to_stress));
  }
  if (drawn.casagrande) {
    const CasagrandeYield& yielded = *drawn.casagrande;
    // a little beyond where they are needed, as on paper
    constexpr double kBeyond = 1.5;
    const double to = kBeyond * yielded.yield_stress;
    lines.push_back(polyline("tangent", yielded.tangent, yielded.bend_stress / kBeyond, to));
    lines.push_back(polyline("bisector", yielded.bisector, yielded.bend_stress, to));
  }
  return lines;
}

void add_start_values(Page& page, const calibration::OedometerFit& fit, std::span<const TestView> views) {
  if (!fit.start) {
    page.paragraph("The fit started from the material of the study; no constructions were drawn.");
    return;
  }
  page.paragraph(
      "The fit starts where a person would: at the values that the customary constructions give on the "
      "measured curves. They only show where the search began; the answer does not rest on them. What they "
      "cannot give is taken from the material of the study.");
  page.table(value_table(fit));
  if (Table steps = rate_step_table(views, *fit.start); !steps.rows.empty()) page.table(std::move(steps));
  std::size_t next = 0;
  for (const TestView& view : views) {
    if (view.summary.held_out || next >= fit.start->tests.size()) continue;
    add_test(page, view, fit.start->tests[next]);
    ++next;
  }
}

}  // namespace isotach::reports
