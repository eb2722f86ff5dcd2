// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Starts, answers and routes.
#include "reports/search_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

using calibration::Coordinate;
using calibration::FitResult;
using calibration::MultiStart;

constexpr std::size_t kShownAnswers = 5;  // columns

Figure plane_figure(const FitResult& result, const MultiStart& multi_start, std::size_t a, std::size_t b) {
  const Coordinate& horizontal = result.coordinates[a];
  const Coordinate& vertical = result.coordinates[b];
  Figure figure;
  figure.x = {.label = quantity_name(horizontal), .logarithmic = horizontal.logarithmic};
  figure.y = {.label = quantity_name(vertical), .logarithmic = vertical.logarithmic};
  figure.height_to_width = 0.75;
  Series starts{.label = "starts", .style = SeriesStyle::discs, .colour = Rgb{160, 160, 160}};
  for (const std::vector<double>& x : multi_start.from) {
    starts.x.push_back(quantity_at(horizontal, x[a]));
    starts.y.push_back(quantity_at(vertical, x[b]));
  }
  Series answers{.label = "answers", .style = SeriesStyle::points, .colour = palette_colour(1)};
  for (const calibration::Cluster& cluster : multi_start.clusters) {
    answers.x.push_back(quantity_at(horizontal, cluster.best[static_cast<Eigen::Index>(a)]));
    answers.y.push_back(quantity_at(vertical, cluster.best[static_cast<Eigen::Index>(b)]));
  }
  figure.series = {std::move(starts), std::move(answers)};
  figure.caption = fmt::format("Starts and answers: {} and {}.", horizontal.name, vertical.name);
  return figure;
}

std::vector<Figure> plane_figures(const FitResult& result, const MultiStart& multi_start) {
  std::vector<Figure> figures;
  const std::size_t count = result.coordinates.size();
  if (count < 2) return figures;
  for (std::size_t k = 0; k + 1 < count; k += 2) {
    figures.push_back(plane_figure(result, multi_start, k, k + 1));
  }
  // the last of an odd number is drawn against the one before it
  if (count % 2 == 1) figures.push_back(plane_figure(result, multi_start, count - 2, count - 1));
  return figures;
}

void add_multi_start(Page& page, const FitResult& result, const MultiStart& multi_start) {
  const std::string failed =
      multi_start.failed == 0
          ? std::string()
          : fmt::format("; from {} of them nothing could be predicted", multi_start.failed);
  const char* moved = multi_start.moved_the_answer
                          ? " One of them ended better than the first, and its answer is the one reported."
                          : "";
  page.paragraph(fmt::format(
      "The fit was repeated from {} other starts, spread evenly over a box about the first within the "
      "bounds{}. Answers less than half a standard error apart count as one: {} remained. One answer means "
      "that the search does not depend on where it starts.{}",
      multi_start.starts, failed, multi_start.clusters.size(), moved));
  page.table(cluster_table(result, multi_start));
  page.figures(plane_figures(result, multi_start));
}

}  // namespace

Table cluster_table(const FitResult& result, const MultiStart& multi_start) {
  Table table{
      .caption = "Different answers from different starts.", .header = {""}, .alignment = {Alignment::left}};
  const std::size_t shown = std::min(kShownAnswers, multi_start.clusters.size());
  for (std::size_t i = 0; i < shown; ++i) {
    table.header.push_back(fmt::format("Answer {}", i + 1));
    table.alignment.push_back(Alignment::right);
  }
  const auto row = [&](std::string name, auto&& text) {
    std::vector<std::string> cells{std::move(name)};
    for (std::size_t i = 0; i < shown; ++i) cells.push_back(text(multi_start.clusters[i]));
    table.rows.push_back(std::move(cells));
  };
  row("starts that end there",
      [](const calibration::Cluster& cluster) { return fmt::format("{}", cluster.count); });
  row("cost above the reported",
      [&](const calibration::Cluster& cluster) { return format_number(cluster.cost - result.main.cost, 2); });
  for (std::size_t k = 0; k < result.coordinates.size(); ++k) {
    row(quantity_name(result.coordinates[k]), [&](const calibration::Cluster& cluster) {
      const double x = cluster.best[static_cast<Eigen::Index>(k)];
      return format_number(quantity_at(result.coordinates[k], x), 4);
    });
  }
  table.notes = {
      "Cost: half the sum of squares of the weighted residuals. An answer whose cost is higher by 2 "
      "or more is far less likely than the best."};
  if (multi_start.clusters.size() > shown) {
    table.notes.push_back(
        fmt::format("{} more, worse ones are in result.json.", multi_start.clusters.size() - shown));
  }
  return table;
}

void add_search(Page& page, const calibration::OedometerFit& fit) {
  const FitResult& result = fit.result;
  if (fit.assessment && fit.assessment->multi_start.starts > 0) {
    add_multi_start(page, result, fit.assessment->multi_start);
  }
  page.table(fit.assessment ? route_table(result, fit.assessment->global_searches) : route_table(result));
  page.figure(cost_figure(result));
}

}  // namespace isotach::reports
