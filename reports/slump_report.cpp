// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines, histories and budgets of one simulated slump.
#include "reports/slump_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/field_animation.hpp"
#include "reports/field_figure.hpp"
#include "reports/fit_sections.hpp"
#include "reports/material_table.hpp"
#include "reports/number.hpp"
#include "reports/slump_budgets.hpp"
#include "reports/slump_tables.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using mpm::HistoryRow;
using mpm::SlumpResult;

constexpr std::size_t kTimesShown = 7;  // as many as the palette has colours

constexpr std::size_t kMapsShown = 6;

constexpr double kHistoryShape = 0.9;  // height to width

double total_energy(const HistoryRow& row) {
  return row.kinetic + row.potential + row.stress_work + row.boundary_work;
}

/// quantity(row) over time, from the first row on that a logarithmic axis can show.
template <class F>
Series history_series(const SlumpResult& result, std::string label, F&& quantity) {
  Series series;
  series.label = std::move(label);
  for (const HistoryRow& row : result.history) {
    if (!(row.time > 0.0)) continue;
    series.x.push_back(row.time);
    series.y.push_back(quantity(row));
  }
  return series;
}

Figure outlines_figure(const datasets::SlumpFile& test, const SlumpResult& result) {
  Figure figure = meridian_figure();
  figure.caption = "Outlines through time; the mould before it was raised, dotted.";
  const mpm::Mould& mould = test.setup.mould;
  const double radius = 0.5 * kMillimetres * mould.diameter;
  const double height = kMillimetres * mould.fill_height;
  figure.series.push_back({.label = "0 s",
                           .style = SeriesStyle::dotted,
                           .x = {radius, radius, 0.0},
                           .y = {0.0, height, height},
                           .colour = Rgb{90, 101, 112}});
  std::size_t colour = 0;
  for (const std::size_t k : spread_indices(result.outlines.size(), kTimesShown)) {
    Series outline = outline_series(result.outlines[k], time_label(test.setup.times[k]));
    outline.colour = palette_colour(colour++);
    figure.series.push_back(std::move(outline));
  }
  return figure;
}

Figure extent_figure(const SlumpResult& result) {
  Figure figure;
  figure.caption = "Height (highest point of the outline) and toe (largest radius) over time.";
  figure.x = {.label = "time (s)", .logarithmic = true};
  figure.y = {.label = "height, toe (mm)", .min = 0.0};
  figure.height_to_width = kHistoryShape;
  figure.series = {
      history_series(result, "height", [](const HistoryRow& row) { return kMillimetres * row.height; }),
      history_series(result, "toe", [](const HistoryRow& row) { return kMillimetres * row.toe; })};
  return figure;
}

Figure energy_figure(const SlumpResult& result) {
  Figure figure;
  figure.caption =
      "Energies over time. The potential energy that the mud gives up becomes work done on it (what the "
      "flow dissipates) and on mould and base; the sum should not change.";
  figure.x = {.label = "time (s)", .logarithmic = true};
  figure.y = {.label = "energy (J)"};
  figure.height_to_width = kHistoryShape;
  figure.series = {
      history_series(result, "potential", [](const HistoryRow& row) { return row.potential; }),
      history_series(result, "stress work", [](const HistoryRow& row) { return row.stress_work; }),
      history_series(result, "boundary work", [](const HistoryRow& row) { return row.boundary_work; }),
      history_series(result, "kinetic", [](const HistoryRow& row) { return row.kinetic; }),
      history_series(result, "sum", total_energy)};
  figure.series.back().style = SeriesStyle::dashed;
  figure.series.back().colour = Rgb{0, 0, 0};
  return figure;
}

/// The row of the history nearest in time.
const HistoryRow& row_at(const SlumpResult& result, double time) {
  return *std::min_element(result.history.begin(), result.history.end(),
                           [time](const HistoryRow& a, const HistoryRow& b) {
                             return std::abs(a.time - time) < std::abs(b.time - time);
                           });
}

Table output_table(const datasets::SlumpFile& test, const SlumpResult& result) {
  using enum Alignment;
  Table table{.caption = "Results at the times asked for.",
              .header = {"Time (s)", "Height (mm)", "Toe (mm)", "Volume change (%)", "Kinetic (J)",
                         "Potential (J)", "Stress work (J)", "Boundary work (J)", "Imbalance (%)"},
              .alignment = {right, right, right, right, right, right, right, right, right}};
  const HistoryRow& start = result.history.front();
  for (std::size_t k = 0; k < result.outlines.size(); ++k) {
    const HistoryRow& row = row_at(result, test.setup.times[k]);
    table.rows.push_back(
        {format_number(test.setup.times[k], 3), format_number(kMillimetres * result.outlines[k].height()),
         format_number(kMillimetres * result.outlines[k].toe()),
         format_number(100.0 * (row.volume / start.volume - 1.0), 2), format_number(row.kinetic, 2),
         format_number(row.potential), format_number(row.stress_work), format_number(row.boundary_work, 2),
         format_number(100.0 * (total_energy(row) - total_energy(start)) / start.potential, 2)});
  }
  table.notes = {
      "Height: highest point of the outline; toe: its largest radius. Imbalance: change of the sum of "
      "energies and work over the potential energy at the start."};
  return table;
}

void add_summary(Page& page, const datasets::SlumpFile& test, const SlumpResult& result) {
  const mpm::Outline& last = result.outlines.back();
  page.verdict(
      Tone::plain,
      fmt::format("After {} the mud stands {} mm high and its toe is at {} mm; it was filled to "
                  "{} mm in a mould of radius {} mm.",
                  time_label(test.setup.times.back()), format_number(kMillimetres * last.height(), 3),
                  format_number(kMillimetres * last.toe(), 3),
                  format_number(kMillimetres * test.setup.mould.fill_height, 3),
                  format_number(0.5 * kMillimetres * test.setup.mould.diameter, 3)));
  for (const Budget& budget : slump_budgets(result)) {
    page.verdict(budget.kept ? Tone::good : Tone::warning, budget.text);
  }
  if (result.floored > 0) {
    page.verdict(Tone::plain,
                 fmt::format("{} of {} point updates left the domain of the law and were set to its "
                             "least pressure, as where the skeleton has lost contact.",
                             result.floored, format_number(result.particle_steps, 3)));
  }
  page.fact("Mould",
            fmt::format("diameter {} mm, fill {} mm, raised at {} m/s, {} wall",
                        format_number(kMillimetres * test.setup.mould.diameter, 3),
                        format_number(kMillimetres * test.setup.mould.fill_height, 3),
                        format_number(test.setup.mould.lift_speed, 2), words_of(test.setup.mould.wall)));
  page.fact("Base", words_of(test.setup.base));
  page.fact("Mud",
            fmt::format("e0 = {}, density {} kg/m³, OCR at the start {}, C_u = {} kPa at |D| = {} 1/s",
                        format_number(result.initial.void_ratio), format_number(result.initial.density),
                        format_number(test.setup.mud.overconsolidation_ratio, 3),
                        format_number(1e-3 * result.initial.undrained_strength, 3),
                        format_number(result.initial.strength_rate, 3)));
  page.fact("Simulation",
            fmt::format("cells of {} mm, {} points, {} steps",
                        format_number(kMillimetres * result.cell_size, 3), result.points, result.steps));
}

/// Fields at output times, and all of it in motion; nothing where the run took no frames.
void add_fields(Page& page, const datasets::SlumpFile& test, const SlumpResult& result) {
  if (result.fields.empty() || result.frames.empty()) return;
  page.section("Strain rate and overconsolidation");
  std::vector<mpm::Frame> shown;
  for (const std::size_t k : spread_indices(result.fields.size(), kMapsShown)) {
    shown.push_back(result.fields[k]);
  }
  for (const FieldQuantity quantity :
       {FieldQuantity::strain_rate_norm, FieldQuantity::overconsolidation_ratio}) {
    page.drawing(field_figure(quantity, shown, test.setup.mould));
  }
  page.drawing(field_animation(FieldQuantity::strain_rate_norm, result.frames, test.setup.mould));
}

}  // namespace

Page slump_report(const RunInfo& run, const datasets::SlumpFile& test, const SlumpResult& result) {
  Page page("Slump test, simulated", subtitle(run));
  add_summary(page, test, result);
  add_warnings(page, run.warnings);
  page.table(output_table(test, result));

  page.section("Outlines and history");
  page.figure(outlines_figure(test, result));
  page.figures(extent_figure(result), energy_figure(result));
  add_fields(page, test, result);
  page.section("Material, start and numerics");
  const std::vector<NamedRun> runs{{"this\u00a0run", test.setup, &result}};
  page.table(material_table(test.material));
  page.table(start_table(runs));
  page.paragraph(numerics_text(runs.front()));
  page.table(budget_table(runs));
  if (!test.assumptions.empty()) page.box(Tone::plain, "Taken for granted:\n" + bulleted(test.assumptions));
  return page;
}

}  // namespace isotach::reports
