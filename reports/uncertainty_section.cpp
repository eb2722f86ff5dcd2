// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Figures and tables of uncertainty.
#include "reports/uncertainty_section.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

using calibration::Coordinate;
using calibration::FitResult;
using calibration::OedometerFit;
using calibration::Profile;
using calibration::ProfileEnd;

/// Gauss-Newton standard error of a coordinate; NaN where it takes part in a null direction.
double std_error_of(const FitResult& result, std::size_t k) {
  if (result.uncertainty.in_null_direction(k)) return std::numeric_limits<double>::quiet_NaN();
  const auto i = static_cast<Eigen::Index>(k);
  return std::sqrt(result.uncertainty.covariance(i, i));
}

/// "crosses the threshold at 0.152", "bound reached at 0.3", "open as far as 4.1".
std::string end_text(ProfileEnd end, const std::string& at) {
  switch (end) {
    case ProfileEnd::crossed:
      return "crosses the threshold at " + at;
    case ProfileEnd::bound:
      return "bound reached at " + at;
    case ProfileEnd::open:
      return "open as far as was looked, " + at;
    case ProfileEnd::unpredictable:
      return "open: nothing can be predicted beyond " + at;
  }
  return {};
}

/// The ends of a profile as numbers in the unit of its quantity.
std::array<std::string, 2> ends_of(const Coordinate& coordinate, const Profile& profile) {
  const double lower = quantity_at(coordinate, profile.lower);
  const double upper = quantity_at(coordinate, profile.upper);
  const int digits = interval_digits(lower, upper);
  return {format_number(lower, digits), format_number(upper, digits)};
}

/// One end of an interval by profile, marked where it is none.
std::string bound_text(ProfileEnd end, const std::string& at) {
  return end == ProfileEnd::crossed ? at : fmt::format("{} ({})", at, calibration::name_of(end));
}

std::string gauss_newton_interval(const FitResult& result, std::size_t k) {
  const double error = result.uncertainty.quantile() * std_error_of(result, k);
  const Coordinate& coordinate = result.coordinates[k];
  const double x = result.main.coordinates[k];
  if (!std::isfinite(error)) return kMissing;
  return interval_text(quantity_at(coordinate, std::max(x - error, coordinate.lower)),
                       quantity_at(coordinate, std::min(x + error, coordinate.upper)));
}

void add_gauge(Page& page, const FitResult& result) {
  const double exponent = -1.0 / (result.parameters->lambda() * result.parameters->I_v());
  page.paragraph(fmt::format(
      "e100 and D_r enter every prediction only through D_r (1+e100)^(−1/(λ I_v)), exactly: with I_v, the "
      "initial stress and the void ratio given they are one number, whatever the data. Here ln[D_r "
      "(1+e100)^(−1/(λ I_v)) · 1 s] = {}. A factor f on D_r is undone by 1+e100 → (1+e100) f^(λ I_v); a "
      "start given by an overconsolidation ratio moves along, OCR0 → OCR0 f^I_v.",
      format_number(std::log(result.parameters->D_r()) + exponent * std::log1p(result.parameters->e100()),
                    6)));
  page.paragraph(gauge_sentence(result));
  for (const std::string& sentence : null_direction_sentences(result)) page.box(Tone::warning, sentence);
}

}  // namespace

Figure profile_figure(const FitResult& result, const Profile& profile) {
  const Coordinate& coordinate = result.coordinates.at(profile.coordinate);
  const double optimum = result.main.coordinates.at(profile.coordinate);
  Figure figure;
  figure.x = {.label = quantity_name(coordinate), .logarithmic = coordinate.logarithmic};
  constexpr double kShown = 1.7;  // of the threshold
  figure.y = {.label = "rise of misfit", .min = 0.0, .max = kShown * profile.threshold};
  figure.height_to_width = 0.7;
  Series curve{.label = "profile", .style = SeriesStyle::line_points, .colour = palette_colour(0)};
  for (const calibration::ProfilePoint& point : profile.points) {
    curve.x.push_back(quantity_at(coordinate, point.x));
    curve.y.push_back(point.delta);
  }
  const double error = std_error_of(result, profile.coordinate);
  if (std::isfinite(error) && error > 0.0) {
    Series parabola{.label = "by standard error", .style = SeriesStyle::dashed, .colour = palette_colour(1)};
    constexpr int kHalf = 30;
    // the interval of the standard error ends where its parabola meets the threshold
    const double quantile = result.uncertainty.quantile();
    const double reach = std::sqrt(kShown) * quantile * error;
    const double scale = profile.threshold / (quantile * quantile * error * error);
    for (int i = -kHalf; i <= kHalf; ++i) {
      const double x = optimum + reach * i / kHalf;
      if (x < coordinate.lower || x > coordinate.upper) continue;
      parabola.x.push_back(quantity_at(coordinate, x));
      parabola.y.push_back(scale * (x - optimum) * (x - optimum));
    }
    figure.series.push_back(std::move(parabola));
  }
  figure.series.push_back(std::move(curve));
  figure.markers = {{MarkerLine::Direction::horizontal, profile.threshold, "95 %"}};
  const auto [lower, upper] = ends_of(coordinate, profile);
  figure.caption = fmt::format("{}: below, {}; above, {}.", coordinate.name,
                               end_text(profile.lower_end, lower), end_text(profile.upper_end, upper));
  return figure;
}

Table interval_table(const OedometerFit& fit) {
  using enum Alignment;
  const FitResult& result = fit.result;
  const bool bootstrapped = fit.assessment && fit.assessment->bootstrap;
  Table table{.caption = "95 % intervals by different means.",
              .header = {"Quantity", "By standard error", "Profile, from", "Profile, to"},
              .alignment = {left, right, right, right}};
  if (bootstrapped) {
    table.header.push_back("Bootstrap");
    table.alignment.push_back(right);
  }
  for (std::size_t k = 0; k < result.coordinates.size(); ++k) {
    const Coordinate& coordinate = result.coordinates[k];
    std::vector<std::string> row{quantity_name(coordinate), gauss_newton_interval(result, k), kMissing,
                                 kMissing};
    if (fit.assessment && k < fit.assessment->profiles.size()) {
      const Profile& profile = fit.assessment->profiles[k];
      const auto [lower, upper] = ends_of(coordinate, profile);
      row[2] = bound_text(profile.lower_end, lower);
      row[3] = bound_text(profile.upper_end, upper);
    }
    if (bootstrapped) {
      const auto i = static_cast<Eigen::Index>(k);
      const calibration::Bootstrap& bootstrap = *fit.assessment->bootstrap;
      row.push_back(interval_text(quantity_at(coordinate, bootstrap.lower[i]),
                                  quantity_at(coordinate, bootstrap.upper[i])));
    }
    table.rows.push_back(std::move(row));
  }
  if (bootstrapped) {
    const calibration::Bootstrap& bootstrap = *fit.assessment->bootstrap;
    table.notes.push_back(fmt::format(
        "Bootstrap: {} sets of data made of the fit and its own residuals, drawn in blocks so that they keep "
        "their correlation, and fitted again; the interval holds 95 % of the answers. {} failed.",
        bootstrap.samples, bootstrap.failed));
  }
  return table;
}

void add_uncertainty(Page& page, const OedometerFit& fit) {
  const FitResult& result = fit.result;
  std::string errors =
      "Standard errors come from the exact derivatives of the predictions at the answer and "
      "the estimated noise with its correlation";
  if (std::isfinite(result.uncertainty.degrees)) {
    errors += fmt::format(
        "; intervals are Student's with {} degrees of freedom, the independent values less "
        "the fitted quantities",
        format_number(result.uncertainty.degrees, 3));
  }
  page.paragraph(
      errors +
      ". They hold for this model and the parameters that were held fixed: what these would change "
      "is in the section on assumed inputs.");
  if (fit.assessment && !fit.assessment->profiles.empty()) {
    page.paragraph(
        "A profile holds one quantity at a value, fits all others again and asks how much the misfit rises "
        "(twice the cost above its least). Values where it stays below the dashed threshold belong to the "
        "95 % interval. Where profile and parabola agree, the standard error tells the whole story; a "
        "profile that stays open says that the data do not bound the quantity on that side.");
    std::vector<Figure> figures;
    for (const Profile& profile : fit.assessment->profiles) {
      figures.push_back(profile_figure(result, profile));
    }
    page.figures(std::move(figures));
    page.table(interval_table(fit));
  }
  if (Table correlation = correlation_table(result); !correlation.rows.empty()) {
    page.table(std::move(correlation));
  }
  add_gauge(page, result);
}

}  // namespace isotach::reports
