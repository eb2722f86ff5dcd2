// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Figures and tables of residuals.
#include "reports/residual_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/distributions.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/time_axis.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;

constexpr double kBand = 2.0;  // noise standard deviations; 95 % of good residuals lie inside
constexpr double kHeight = 0.7;

/// A probability as it is read: below 1e-4 only that it is.
std::string probability(double p) {
  if (!std::isfinite(p)) return kMissing;
  if (p < 1e-4) return "< 0.0001";
  return fmt::format("{:.{}f}", p, p < 0.01 ? 4 : 2);
}

std::string yes_no(bool value) {
  return value ? "yes" : "no";
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
  figure.height_to_width = kHeight;
  figure.series = {{.style = residuals.size() < 100 ? SeriesStyle::discs : SeriesStyle::dots,
                    .x = std::move(at),
                    .y = residuals,
                    .in_legend = false}};
  figure.markers = {{MarkerLine::Direction::horizontal, kBand, ""},
                    {MarkerLine::Direction::horizontal, -kBand, ""}};
  return figure;
}

/// Whitened residuals in order of size against what noise would give at that place.
Figure quantile_figure(const TestView& view) {
  std::vector<double> sorted = view.white;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> expected;
  const auto count = static_cast<double>(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    // Blom's (1958) plotting positions
    expected.push_back(calibration::normal_quantile((static_cast<double>(i) + 0.625) / (count + 0.25)));
  }
  Figure figure;
  figure.caption = fmt::format(
      "{}: residuals freed of the estimated noise, in order of size, against the normal distribution. On the "
      "line: noise of the estimated size; ends that bend away: outliers.",
      view.summary.name);
  figure.x = {.label = "normal quantile"};
  figure.y = {.label = "whitened residual"};
  figure.height_to_width = kHeight;
  const double end = expected.empty() ? 1.0 : expected.back();
  figure.series = {{.style = SeriesStyle::dashed,
                    .x = {-end, end},
                    .y = {-end, end},
                    .colour = Rgb{120, 120, 120},
                    .in_legend = false},
                   {.style = SeriesStyle::dots,
                    .x = std::move(expected),
                    .y = std::move(sorted),
                    .colour = palette_colour(0),
                    .in_legend = false}};
  return figure;
}

std::vector<Figure> figures_of(const TestView& view) {
  std::vector<double> times;
  std::vector<double> stresses;
  for (const experiments::ComparedValue& value : view.experiment.values()) {
    const datasets::OedometerRow& row = view.experiment.row_of(value);
    times.push_back(row.time);
    stresses.push_back(1e-3 * row.axial_stress);
  }
  const TimeUnit unit = time_unit_for(times.back());
  for (double& time : times) time /= unit.seconds;
  const std::string title = title_of(view.summary);
  const Axis time{.label = fmt::format("time ({})", unit.name)};
  std::vector<Figure> figures{
      residual_figure(time, times, view.scaled, title + ": residuals against time."),
      residual_figure({.label = "axial effective stress (kPa)", .logarithmic = true}, std::move(stresses),
                      view.scaled, title + ": residuals against stress.")};
  if (!view.white.empty()) {
    Figure white = residual_figure(time, std::move(times), view.white,
                                   title + ": residuals freed of the estimated noise, against time.");
    white.y.label = "whitened residual";
    figures.push_back(std::move(white));
    figures.push_back(quantile_figure(view));
  }
  return figures;
}

}  // namespace

Table stage_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Residuals by stage, in units of the stated noise.",
              .header = {"Test", "Stage", "Stress (kPa)", "Values", "rms", "Mean", "Chance", "Missed"},
              .alignment = {left, left, right, right, right, right, right, left}};
  std::vector<std::optional<Rgb>> none(table.header.size());
  std::vector<std::optional<Rgb>> missed(table.header.size(), Rgb{252, 228, 214});
  for (const calibration::TestCheck& check : fit.checks) {
    std::string name = check.held_out ? check.name + " (held out)" : check.name;
    for (const calibration::StageCheck& stage : check.stages) {
      table.rows.push_back({std::exchange(name, ""), stage.stage,
                            fmt::format("{} to {}", format_number(1e-3 * stage.from_stress, 3),
                                        format_number(1e-3 * stage.to_stress, 3)),
                            fmt::format("{}", stage.count), format_number(stage.rms_over_noise, 3),
                            format_number(stage.mean_over_noise, 2), probability(stage.p_value),
                            yes_no(stage.misfit)});
      table.shades.push_back(stage.misfit ? missed : none);
    }
  }
  table.notes = {fmt::format(
      "rms: root mean square, 1 = as good as the noise allows. Mean: positive where the model lies above the "
      "measured values (of stress, or of strain where the stress is given). Chance: the probability that "
      "independent noise alone would be as large. Missed: rms above {} and chance below 1 in 1000.",
      format_number(calibration::kStageMisfit, 2))};
  return table;
}

Table pattern_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Whether residuals, in the order of reading, look like noise.",
              .header = {"Test", "Runs", "Expected", "Chance", "Correlation", "Ljung-Box: chance", "Whitened",
                         "Pattern"},
              .alignment = {left, right, right, right, right, right, right, left}};
  for (const calibration::TestCheck& check : fit.checks) {
    const bool fitted = !check.held_out;
    table.rows.push_back(
        {check.held_out ? check.name + " (held out)" : check.name, fmt::format("{}", check.runs.runs),
         format_number(check.runs.expected, 3), probability(check.runs.p_value),
         format_number(check.autocorrelation, 2), probability(check.ljung_box.p_value),
         fitted ? probability(check.whitened.p_value) : std::string(kMissing), yes_no(check.patterned)});
  }
  table.notes = {
      "Runs: stretches of residuals of one sign; too few mean that a trend is left. Correlation: of each "
      "residual with the next. Ljung-Box: probability that noise without memory would be as correlated over "
      "ten readings. Whitened: the same once the estimated correlation is taken out; small values there mean "
      "that the pattern is more than noise with a memory.",
      "Pattern: runs or Ljung-Box test below 1 in 1000 before whitening."};
  return table;
}

Table noise_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Noise, stated by the study and estimated from the residuals.",
              .header = {"Test", "Quantity", "Values", "Stated level", "Estimated", "Stated floor (kPa)",
                         "Estimated", "Correlation", "Independent values"},
              .alignment = {left, left, right, right, right, right, right, right, right}};
  for (const calibration::ChannelNoise& channel : fit.noise.channels) {
    const bool stress = channel.quantity.starts_with("ln");
    const auto level = [&](double value) {
      return stress ? fmt::format("{} %", format_number(100.0 * value, 3)) : format_number(value, 3);
    };
    const auto floor = [&](double value) {
      return stress ? format_number(1e-3 * value, 2) : std::string(kMissing);
    };
    table.rows.push_back(
        {channel.test, stress ? "stress" : "strain", fmt::format("{}", channel.count),
         level(channel.stated_level), channel.estimated ? level(channel.model.level) : "as stated",
         floor(channel.stated_floor), channel.estimated ? floor(channel.model.floor) : std::string(kMissing),
         format_number(channel.model.neighbours(), 3), format_number(channel.model.effective_count, 3)});
  }
  table.notes = {
      "Level: standard deviation, of the stress in per cent of it, of the strain as it is (−). Floor: a part "
      "of the stress noise that does not shrink with the stress. Correlation: of one reading's error with "
      "the "
      "next; errors that last count as fewer independent values. The fit weights the readings by the "
      "estimated noise; whether a test is met is judged by the stated one."};
  return table;
}

void add_residuals(Page& page, const OedometerFit& fit, std::span<const TestView> views) {
  page.paragraph(fmt::format(
      "A residual is model minus measured over the noise that the study states: of ln stress, where the "
      "strain history was imposed (there the noise adds up that of stress and that of strain times the slope "
      "of the stage), of strain, where the stress was. Were the model right, 95 % of the residuals would lie "
      "between the lines at ±{:.0f}, without pattern.",
      kBand));
  if (!fit.checks.empty()) {
    page.table(stage_table(fit));
    page.table(pattern_table(fit));
  }
  if (!fit.noise.channels.empty()) page.table(noise_table(fit));
  for (const TestView& view : views) page.figures(figures_of(view));
}

}  // namespace isotach::reports
