// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/verification_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "reports/number.hpp"

namespace isotach::reports {

using verification::CrossCheckCurve;
using verification::CrossCheckRow;

namespace {

constexpr double kShape = 0.75;

/// Sorted values of one field of the tangent records.
std::vector<double> sorted_errors(const verification::TangentStudy& study,
                                  double verification::TangentRecord::*field) {
  std::vector<double> values;
  for (const auto& record : study.records) values.push_back(record.*field);
  std::sort(values.begin(), values.end());
  return values;
}

Series survival_series(const std::vector<double>& sorted, std::string label) {
  Survival curve = survival(sorted);
  return {.label = std::move(label), .x = std::move(curve.value), .y = std::move(curve.share)};
}

template <class Field>
std::vector<double> column(const CrossCheckCurve& curve, Field field) {
  std::vector<double> values;
  for (const CrossCheckRow& row : curve.rows) values.push_back(field(row));
  return values;
}

}  // namespace

Survival survival(const std::vector<double>& sorted) {
  constexpr std::size_t kPoints = 300;
  Survival curve;
  const std::size_t n = sorted.size();
  // dense where few are left: ranks from the top, evenly in the logarithm
  std::vector<std::size_t> ranks;
  for (std::size_t k = 0; k < kPoints && n > 0; ++k) {
    const double share = static_cast<double>(k) / (kPoints - 1);
    ranks.push_back(static_cast<std::size_t>(std::llround(std::pow(static_cast<double>(n), share))));
  }
  std::sort(ranks.begin(), ranks.end(), std::greater<>());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  for (const std::size_t rank : ranks) {
    curve.value.push_back(sorted[n - rank]);
    curve.share.push_back(static_cast<double>(rank) / static_cast<double>(n));
  }
  return curve;
}

Figure convergence_figure(const verification::ConvergenceStudy& study) {
  Figure figure;
  figure.caption =
      "Error of stress at the end of a general path over the strain of a substep. The scheme with (5a) as "
      "printed does "
      "not converge: it integrates to twice the time.";
  figure.x = {.label = "strain of a substep |D| tau (-)", .logarithmic = true};
  figure.y = {.label = "|dT|/|T| (-)", .logarithmic = true};
  figure.height_to_width = kShape;
  figure.width = FigureWidth::half;
  for (const auto& scheme : study.schemes) {
    figure.series.push_back(
        {.label = scheme.scheme, .style = SeriesStyle::line_points, .x = scheme.step, .y = scheme.error});
  }
  return figure;
}

Figure estimate_figure(const verification::ConvergenceStudy& study) {
  Figure figure;
  figure.caption =
      "The error estimate EST = |w - v| of one substep: of order 2 as it should be, of order 1 by (5a) as "
      "printed, so "
      "that step sizes follow the wrong law.";
  figure.x = {.label = "strain of the substep |D| tau (-)", .logarithmic = true};
  figure.y = {.label = "EST/|w| (-)", .logarithmic = true};
  figure.height_to_width = kShape;
  figure.width = FigureWidth::half;
  figure.series = {
      {.label = fmt::format("corrected, order {}", format_number(study.est_correct_order.order, 3)),
       .style = SeriesStyle::line_points,
       .x = study.est_step,
       .y = study.est_correct},
      {.label = fmt::format("(5a) as printed, order {}", format_number(study.est_printed_order.order, 3)),
       .style = SeriesStyle::line_points,
       .x = study.est_step,
       .y = study.est_printed}};
  return figure;
}

Figure error_distribution_figure(const verification::RandomPathStudy& study) {
  Figure figure;
  figure.caption =
      fmt::format("Share of {} random paths whose error exceeds a multiple of the tolerance {:.0e}.",
                  study.records.size(), study.plan.tolerance);
  figure.x = {.label = "achieved error/TOL (-)", .logarithmic = true};
  figure.y = {.label = "share of paths above (-)", .logarithmic = true};
  figure.height_to_width = kShape;
  figure.width = FigureWidth::half;
  figure.series = {survival_series(study.errors_over_tolerance(), "error/TOL"),
                   survival_series(study.errors_over_path(), "error/TOL per 0.1 of path")};
  figure.markers = {{MarkerLine::Direction::vertical, 10.0, "10 TOL"},
                    {MarkerLine::Direction::horizontal, 1e-3, "0.1 %"}};
  return figure;
}

Figure error_over_length_figure(const verification::RandomPathStudy& study) {
  constexpr std::size_t kMostDots = 5000;
  Figure figure;
  figure.caption = "Achieved error over the length of the path, integral |D| dt; a dot a path.";
  figure.x = {.label = "length of the path (-)", .logarithmic = true};
  figure.y = {.label = "achieved error/TOL (-)", .logarithmic = true};
  figure.height_to_width = kShape;
  figure.width = FigureWidth::half;
  Series dots{.label = "path", .style = SeriesStyle::dots, .in_legend = false};
  const std::size_t stride = std::max<std::size_t>(1, study.records.size() / kMostDots);
  for (std::size_t i = 0; i < study.records.size(); i += stride) {
    if (study.records[i].substeps == 0) continue;
    dots.x.push_back(study.records[i].length);
    dots.y.push_back(study.records[i].error / study.plan.tolerance);
  }
  figure.series = {std::move(dots)};
  figure.markers = {{MarkerLine::Direction::horizontal, 10.0, "10 TOL"}};
  return figure;
}

Figure tangent_figure(const verification::TangentStudy& study) {
  using verification::TangentRecord;
  Figure figure;
  figure.caption = "Share of increments whose tangent differs by more than so much, relative to its norm.";
  figure.x = {.label = "|C - C'|/|C'| (-)", .logarithmic = true};
  figure.y = {.label = "share of increments above (-)", .logarithmic = true};
  figure.height_to_width = 0.5;
  figure.series = {
      survival_series(sorted_errors(study, &TangentRecord::jets), "Jets by another route"),
      survival_series(sorted_errors(study, &TangentRecord::differences), "differences of the discrete map"),
      survival_series(sorted_errors(study, &TangentRecord::exact_solution), "tangent of the exact solution")};
  return figure;
}

Figure cross_check_figure(const CrossCheckCurve& curve) {
  Figure figure;
  figure.caption = fmt::format("{}: {}.", curve.named.path.name, curve.named.meaning);
  figure.height_to_width = kShape;
  figure.width = FigureWidth::half;
  const auto p = column(curve, [](const CrossCheckRow& row) { return row.p_kPa; });
  const auto q = column(curve, [](const CrossCheckRow& row) { return row.q_kPa; });
  if (curve.named.over_time) {
    const auto time = column(curve, [](const CrossCheckRow& row) { return row.time; });
    const auto e = column(curve, [](const CrossCheckRow& row) { return row.void_ratio; });
    const bool creeps = std::abs(e.back() - e.front()) > 1e-9;
    figure.x = {.label = "time (s)", .logarithmic = true};
    figure.y = {.label = creeps ? "void ratio (-)" : "p (kPa)"};
    figure.series = {{.label = "cvode", .x = time, .y = creeps ? e : p}};
    if (!creeps) {
      figure.series.push_back(
          {.label = "fellin-ostermann",
           .style = SeriesStyle::dashed,
           .x = time,
           .y = column(curve, [](const CrossCheckRow& row) { return row.fellin_ostermann_p_kPa; })});
    }
    return figure;
  }
  figure.x = {.label = "p (kPa)"};
  figure.y = {.label = "q (kPa)"};
  figure.series = {{.label = "cvode", .x = p, .y = q},
                   {.label = "fellin-ostermann",
                    .style = SeriesStyle::dashed,
                    .x = column(curve, [](const CrossCheckRow& row) { return row.fellin_ostermann_p_kPa; }),
                    .y = column(curve, [](const CrossCheckRow& row) { return row.fellin_ostermann_q_kPa; })}};
  return figure;
}

Figure cross_check_error_figure(const std::vector<CrossCheckCurve>& curves) {
  Figure figure;
  figure.caption = "Achieved error of Fellin-Ostermann against CVODE along the named paths, row by row.";
  figure.x = {.label = "row"};
  figure.y = {.label = "max(|dT|/|T|, |de|) (-)", .logarithmic = true};
  figure.height_to_width = 0.5;
  for (const CrossCheckCurve& curve : curves) {
    Series series{.label = curve.named.path.name};
    for (std::size_t i = 0; i < curve.rows.size(); ++i) {
      series.x.push_back(static_cast<double>(i));
      series.y.push_back(curve.rows[i].fellin_ostermann_error);
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

Figure work_figure(const std::vector<verification::WorkPrecision>& work, const std::string& path, bool time) {
  Figure figure;
  figure.x = {.label = "achieved error (-)", .logarithmic = true, .reversed = true};
  figure.y = {.label = time ? "time (us)" : "evaluations of the law", .logarithmic = true};
  figure.height_to_width = kShape;
  figure.width = FigureWidth::half;
  for (const auto& curve : work) {
    if (curve.named.path.name != path) continue;
    figure.caption =
        fmt::format("{} ({}): {} against achieved error, tolerance tightened tenfold from point to point.",
                    path, curve.named.stiff ? "stiff" : "easy", time ? "time" : "evaluations");
    Series series{.label = std::string(integrators::name(curve.method)), .style = SeriesStyle::line_points};
    for (const auto& point : curve.points) {
      series.x.push_back(std::max(point.error, 1e-16));
      series.y.push_back(time ? point.microseconds : static_cast<double>(point.statistics.evaluations));
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace isotach::reports
