// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Figures of strain or stress against the logarithm of time.
#include "reports/time_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/time_axis.hpp"

namespace isotach::reports {
namespace {

using datasets::Stage;
using experiments::ComparedValue;
using experiments::kNoRow;
using experiments::ValueKind;

constexpr double kPercent = 100.0;
constexpr Rgb kPale{150, 190, 220};
constexpr double kHeight = 0.75;

/// Points (s, quantity) that become a series.
struct Points {
  std::vector<double> time;
  std::vector<double> value;
  void add(double t, double v) {
    time.push_back(t);
    value.push_back(v);
  }
};

Series series_of(std::string label, SeriesStyle style, Rgb colour, Points points, const TimeUnit& unit) {
  for (double& t : points.time) t /= unit.seconds;
  return {.label = std::move(label),
          .style = style,
          .x = std::move(points.time),
          .y = std::move(points.value),
          .colour = colour};
}

Figure frame(const TimeUnit& unit, std::string since) {
  Figure figure;
  figure.x = {.label = fmt::format("time since {} ({})", since, unit.name), .logarithmic = true};
  figure.height_to_width = kHeight;
  return figure;
}

/// How a load step's readings were parted into consolidation and creep.
const experiments::PrimaryConsolidation* consolidation_of(const TestView& view, std::size_t step) {
  for (const auto& consolidation : view.experiment.protocol().consolidation) {
    if (consolidation.step == step) return &consolidation;
  }
  return nullptr;
}

Figure step_figure(const TestView& view, std::size_t index) {
  const datasets::OedometerRecord& record = view.experiment.test().record;
  const datasets::LoadStep& step = record.steps[index];
  const std::size_t end = step.first + step.count;
  const TimeUnit unit = time_unit_for(record.rows[end - 1].time - step.begin);
  Points before;
  Points compared;
  for (std::size_t i = step.first; i < end; ++i) {
    const auto is_compared = [&](const ComparedValue& value) { return value.row == i; };
    const auto& values = view.experiment.values();
    Points& into = std::any_of(values.begin(), values.end(), is_compared) ? compared : before;
    into.add(record.rows[i].time - step.begin, kPercent * record.rows[i].axial_strain);
  }
  Points model;
  for (const experiments::PathPoint& point : view.path) {
    if (point.time > step.begin && point.time <= record.rows[end - 1].time) {
      model.add(point.time - step.begin, kPercent * point.axial_strain);
    }
  }
  Figure figure = frame(unit, "the load");
  figure.y = {.label = "axial strain (%)", .reversed = true};
  const auto add = [&](std::string label, SeriesStyle style, Rgb colour, Points points) {
    if (points.time.empty()) return;  // nothing to be in the legend for
    figure.series.push_back(series_of(std::move(label), style, colour, std::move(points), unit));
  };
  add("measured", SeriesStyle::discs, kPale, std::move(before));
  add("measured, compared", SeriesStyle::discs, palette_colour(0), std::move(compared));
  add("model", SeriesStyle::line, palette_colour(1), std::move(model));
  figure.caption = fmt::format("{}, step {} ({}) to {} kPa.", title_of(view.summary), index + 1,
                               datasets::name_of(step.stage), format_number(1e-3 * step.load));
  const auto* consolidation = consolidation_of(view, index);
  if (consolidation == nullptr) {
    figure.caption += " The test starts at the end of this step, which is not compared.";
  } else if (consolidation->end && *consolidation->end > 0.0) {
    figure.markers.push_back(
        {MarkerLine::Direction::vertical, *consolidation->end / unit.seconds, "end of primary"});
    figure.caption += fmt::format(" End of primary consolidation: {}.", consolidation->how);
  }
  return figure;
}

/// Values first .. end - 1, read while stress or strain was held.
Figure hold_figure(const TestView& view, std::size_t first, std::size_t end) {
  const auto& values = view.experiment.values();
  const bool creep = values[first].kind == ValueKind::strain;
  // the step before the first value ends when the hold begins
  const double begin = values[first].step < view.path.size() ? view.path[values[first].step].time
                                                             : view.experiment.protocol().start.time;
  const TimeUnit unit = time_unit_for(view.experiment.row_of(values[end - 1]).time - begin);
  Points measured;
  Points model;
  for (std::size_t i = first; i < end; ++i) {
    const ComparedValue& value = values[i];
    const datasets::OedometerRow& row = view.experiment.row_of(value);
    measured.add(row.time - begin, creep ? kPercent * value.measured : 1e-3 * row.axial_stress);
    if (value.step + 1 >= view.path.size()) continue;
    const experiments::PathPoint& point = view.path[value.step + 1];
    const double origin =
        value.strain_origin == kNoRow ? 0.0 : view.path[value.strain_origin + 1].axial_strain;
    model.add(row.time - begin, creep ? kPercent * (point.axial_strain - origin) : 1e-3 * point.axial_stress);
  }
  Figure figure = frame(unit, creep ? "the hold began" : "strain was held");
  figure.y = creep ? Axis{.label = "axial strain since then (%)", .reversed = true}
                   : Axis{.label = "axial effective stress (kPa)"};
  figure.series = {series_of("measured", SeriesStyle::discs, palette_colour(0), std::move(measured), unit),
                   series_of("model", SeriesStyle::line, palette_colour(1), std::move(model), unit)};
  figure.caption =
      creep ? fmt::format("{}: creep at {} kPa.", title_of(view.summary),
                          format_number(1e-3 * view.experiment.row_of(values[first]).axial_stress))
            : fmt::format("{}: relaxation from {} kPa.", title_of(view.summary),
                          format_number(1e-3 * view.experiment.row_of(values[first]).axial_stress));
  return figure;
}

}  // namespace

std::vector<Figure> time_figures(const TestView& view) {
  std::vector<Figure> figures;
  const datasets::OedometerRecord& record = view.experiment.test().record;
  if (view.stepwise()) {
    for (std::size_t i = 0; i < record.steps.size(); ++i) {
      if (record.steps[i].count >= kFewestReadings) figures.push_back(step_figure(view, i));
    }
    return figures;
  }
  const auto& values = view.experiment.values();
  for (std::size_t first = 0; first < values.size();) {
    const Stage stage = view.experiment.row_of(values[first]).stage;
    std::size_t end = first + 1;
    while (end < values.size() && values[end].row == values[end - 1].row + 1 &&
           view.experiment.row_of(values[end]).stage == stage) {
      ++end;
    }
    const bool held = stage == Stage::hold || stage == Stage::relax;
    if (held && end - first >= kFewestReadings) figures.push_back(hold_figure(view, first, end));
    first = end;
  }
  return figures;
}

}  // namespace isotach::reports
