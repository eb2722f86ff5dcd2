// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/slump_map_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/contour_lines.hpp"
#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/uncertainty_section.hpp"
#include "reports/units.hpp"

namespace isotach::reports {

namespace {

using calibration::Coordinate;
using calibration::MisfitMap;
using calibration::SlumpComparison;
using calibration::SlumpFit;
using calibration::SlumpMap;

/// Rises of twice the cost within which two parameters lie together with a likelihood.
struct Level {
  double rise;
  const char* label;
  SeriesStyle style;
};
constexpr Level kLevels[] = {{2.30, "68 %", SeriesStyle::line},
                             {5.99, "95 %", SeriesStyle::line},
                             {9.21, "99 %", SeriesStyle::dashed}};

std::string rounded_mm(double metres) {
  return format_number(kMillimetres * metres, 2);
}

Figure map_figure(const SlumpFit& fit, const MisfitMap& map) {
  const Coordinate& first = fit.result.coordinates.at(map.first);
  const Coordinate& second = fit.result.coordinates.at(map.second);
  const double inflation = fit.result.uncertainty.inflation * fit.result.uncertainty.inflation;
  Figure figure;
  figure.x = {.label = quantity_name(first), .logarithmic = first.logarithmic};
  figure.y = {.label = quantity_name(second), .logarithmic = second.logarithmic};
  figure.height_to_width = 0.75;
  const auto in_quantity = [](const Coordinate& coordinate, const std::vector<double>& x) {
    std::vector<double> values;
    for (const double value : x) values.push_back(quantity_at(coordinate, value));
    return values;
  };
  const std::vector<double> x = in_quantity(first, map.x);
  const std::vector<double> y = in_quantity(second, map.y);
  figure.x.min = x.front();
  figure.x.max = x.back();
  figure.y.min = y.front();
  figure.y.max = y.back();
  std::size_t colour = 0;
  for (const Level& level : kLevels) {
    Series line = contour_line(x, y, map.rise, level.rise * inflation);
    line.label = level.label;
    line.style = level.style;
    line.colour = palette_colour(colour++);
    if (!line.x.empty()) figure.series.push_back(std::move(line));
  }
  Series simulated{.label = "simulated", .style = SeriesStyle::dots, .colour = palette_colour(6)};
  for (const auto& point : fit.map->training) {
    simulated.x.push_back(quantity_at(first, point[map.first]));
    simulated.y.push_back(quantity_at(second, point[map.second]));
  }
  figure.series.push_back(std::move(simulated));
  figure.series.push_back({.label = "answer",
                           .style = SeriesStyle::discs,
                           .x = {quantity_at(first, fit.result.main.coordinates[map.first])},
                           .y = {quantity_at(second, fit.result.main.coordinates[map.second])},
                           .colour = palette_colour(1)});
  figure.caption = fmt::format(
      "Where {} and {} lie together with the likelihoods given, all other parameters at their best; a long "
      "valley means "
      "that outlines hold one combination of the two better than either. Dots: where all tests were "
      "simulated.",
      first.name, second.name);
  return figure;
}

Table profile_table(const SlumpFit& fit) {
  using enum Alignment;
  Table table{.caption = "95 % intervals by profile.",
              .header = {"Parameter", "Answer", "From", "To", "Ends", "Verdict"},
              .alignment = {left, right, right, right, left, left}};
  for (const calibration::Profile& profile : fit.map->profiles) {
    const Coordinate& coordinate = fit.result.coordinates[profile.coordinate];
    const calibration::ParameterEstimate& estimate = estimate_of(fit.result, *coordinate.id);
    table.rows.push_back(
        {quantity_name(coordinate),
         format_number(quantity_at(coordinate, fit.result.main.coordinates[profile.coordinate]), 4),
         format_number(quantity_at(coordinate, profile.lower), 4),
         format_number(quantity_at(coordinate, profile.upper), 4),
         fmt::format("{}; {}", name_of(profile.lower_end), name_of(profile.upper_end)),
         std::string(name_of(estimate.verdict))});
  }
  return table;
}

/// A part of an outline, by its place from toe (0) to axis (1).
struct Zone {
  const char* name;
  double from, to;
};
constexpr Zone kZones[] = {{"toe", 0.0, 0.25}, {"flank", 0.25, 0.7}, {"top", 0.7, 1.0}};

/// Mean signed distance on a zone of one outline, and what its noise would make of it.
struct ZoneMisfit {
  std::string test;
  double time = 0.0;
  const char* zone = "";
  double mean = 0.0;  ///< m
  double rms_over_noise = 0.0;
};

std::vector<ZoneMisfit> zone_misfits(const SlumpFit& fit) {
  std::vector<ZoneMisfit> all;
  for (const SlumpComparison& comparison : fit.comparisons) {
    const experiments::SlumpExperiment& test = *comparison.experiment;
    const experiments::Values noise = test.in_noise(comparison.distances);
    const auto& outlines = test.test().outlines;
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      for (const Zone& zone : kZones) {
        ZoneMisfit misfit{test.name(), outlines[k].time, zone.name};
        double squares = 0.0;
        std::size_t count = 0;
        for (const experiments::OutlineStation& station : test.stations()) {
          if (station.outline != k || station.place < zone.from || station.place >= zone.to) continue;
          for (const std::size_t i : station.points) {
            misfit.mean += comparison.distances[i];
            squares += noise[i] * noise[i];
            ++count;
          }
        }
        if (count == 0) continue;
        misfit.mean /= static_cast<double>(count);
        misfit.rms_over_noise = std::sqrt(squares / static_cast<double>(count));
        all.push_back(misfit);
      }
    }
  }
  return all;
}

}  // namespace

void add_slump_map(Page& page, const SlumpFit& fit) {
  if (!fit.map) return;
  const SlumpMap& map = *fit.map;
  page.heading("How well the outlines hold what was fitted");
  page.paragraph(fmt::format(
      "Every test was simulated at {} points about the answer{}{}. Gaussian processes of the {} principal "
      "components "
      "of all distances stand in for the simulations: points left out are missed by {} times the noise{}.",
      map.points, map.failed > 0 ? fmt::format(", {} of them in vain", map.failed) : std::string(),
      map.enlarged > 0 ? fmt::format(", in a region that was widened {}",
                                     map.enlarged == 1 ? "once" : fmt::format("{} times", map.enlarged))
                       : std::string(),
      map.surrogate->components(), format_number(map.surrogate->error(), 2),
      map.surrogate->error() < 0.5 ? "" : ", which is much: intervals are rough"));
  std::vector<Figure> figures;
  for (const MisfitMap& misfit : map.maps) page.figure(map_figure(fit, misfit));
  for (const calibration::Profile& profile : map.profiles) {
    figures.push_back(profile_figure(fit.result, profile));
  }
  std::size_t i = 0;
  for (; i + 1 < figures.size(); i += 2) page.figures(std::move(figures[i]), std::move(figures[i + 1]));
  if (i < figures.size()) page.figure(std::move(figures[i]));
  page.table(profile_table(fit));
}

void add_simulation_error(Page& page, const calibration::SimulationError& error) {
  using enum Alignment;
  if (error.variants.empty()) return;
  Table table{
      .caption = "Distance between simulated outlines when the numerics change (root mean square, mm).",
      .header = {"Change", "Rim gone", "While lifting", "Failed"},
      .alignment = {left, right, right, right}};
  for (const calibration::NumericalVariant& variant : error.variants) {
    table.rows.push_back({variant.name, rounded_mm(variant.outline), rounded_mm(variant.lifting),
                          fmt::format("{}", variant.failed)});
  }
  table.notes = {fmt::format(
      "Taken for the error of a simulated outline: {} mm over all tests, {} mm while lifting, each outline "
      "by its own differences and by what three thousandths of I_v do to it; shared along {} % of an "
      "outline's length and over a factor of {} in time. It is part of the covariance, so that nothing is "
      "fitted below it. An error common to all these grids is not seen this way.",
      rounded_mm(error.error.outline), rounded_mm(error.error.lifting),
      format_number(100.0 * error.error.along, 2), format_number(std::exp(error.error.in_time), 2))};
  page.table(std::move(table));
}

void add_where_it_fails(Page& page, const SlumpFit& fit) {
  using enum Alignment;
  std::vector<ZoneMisfit> all = zone_misfits(fit);
  std::stable_sort(all.begin(), all.end(), [](const ZoneMisfit& a, const ZoneMisfit& b) {
    return a.rms_over_noise > b.rms_over_noise;
  });
  constexpr std::size_t kShown = 8;
  const auto above = static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(), [](const ZoneMisfit& misfit) { return misfit.rms_over_noise > 1.5; }));
  page.paragraph(
      fmt::format("Toe, flank and top of all outlines are {} parts; {} of them are missed by more than 1.5 "
                  "times the noise.",
                  all.size(), above));
  if (all.size() > kShown) all.resize(kShown);
  Table table{.caption = "Where simulation and data disagree most.",
              .header = {"Test", "Time (s)", "Part", "Mean distance (mm)", "rms / noise"},
              .alignment = {left, right, left, right, right}};
  for (const ZoneMisfit& misfit : all) {
    table.rows.push_back({misfit.test, format_number(misfit.time), misfit.zone, rounded_mm(misfit.mean),
                          format_number(misfit.rms_over_noise, 2)});
  }
  table.notes = {
      "Positive where the simulated mud reaches too far. Toe: the first quarter of the outline from the "
      "base; top: the "
      "last 30 %, at the axis."};
  page.table(std::move(table));
}

}  // namespace isotach::reports
