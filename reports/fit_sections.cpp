// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Verdicts, tables and figures of any fit.
#include "reports/fit_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/estimates.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

using calibration::FitResult;
using calibration::OptimiserResult;
using calibration::ParameterEstimate;
using calibration::TestSummary;
using calibration::Verdict;

std::string with_unit(const std::string& number, std::string_view unit) {
  return unit == "-" ? number : fmt::format("{} {}", number, unit);
}

/// All routes of a fit, the one reported first.
std::vector<const OptimiserResult*> routes_of(const FitResult& result) {
  std::vector<const OptimiserResult*> routes{&result.main};
  if (result.check) routes.push_back(&*result.check);
  return routes;
}

/// f(point) of every improvement against the number of evaluations, as a staircase would be read.
template <class F>
Figure trace_figure(const FitResult& result, F&& f) {
  Figure figure;
  figure.x.label = "evaluations";
  const auto routes = routes_of(result);
  figure.x.logarithmic = routes.size() > 1;  // a route with derivatives needs tens, one without hundreds
  for (std::size_t k = 0; k < routes.size(); ++k) {
    Series series;
    series.label = routes[k]->route;
    series.style = SeriesStyle::line_points;
    for (const calibration::TracePoint& point : routes[k]->trace) {
      series.x.push_back(point.evaluation);
      series.y.push_back(f(point));
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

std::vector<std::string> texts_with(const std::vector<ParameterEstimate>& estimates, Verdict verdict) {
  std::vector<std::string> texts;
  for (const ParameterEstimate& estimate : estimates) {
    if (estimate.verdict != verdict) continue;
    const bool explained = verdict != Verdict::identified && !estimate.words.empty();
    texts.push_back(parameter_text(estimate) + (explained ? fmt::format(" ({})", estimate.words) : ""));
  }
  return texts;
}

/// White at 0, deep blue at 1, deep orange at -1.
Rgb correlation_colour(double value) {
  const Rgb full = value < 0.0 ? palette_colour(1) : palette_colour(0);
  const double share = 0.7 * std::min(1.0, std::abs(value));  // the number stays legible
  const auto mix = [&](std::uint8_t colour) {
    return static_cast<std::uint8_t>(std::lround(255.0 + share * (colour - 255.0)));
  };
  return {mix(full.red), mix(full.green), mix(full.blue)};
}

/// Tests of one kind and how far the worst of them is from the data.
struct Group {
  std::vector<std::string> names;
  std::vector<std::string> missed;
  double worst = 0.0;
};

Group group_of(const FitResult& result, bool held_out) {
  Group group;
  for (const TestSummary& test : result.tests) {
    if (test.held_out != held_out) continue;
    group.names.push_back(test.name);
    group.worst = std::max(group.worst, test.rms_over_noise);
    if (test.rms_over_noise > calibration::kAdequate) {
      group.missed.push_back(fmt::format("{} ({})", test.name, format_number(test.rms_over_noise, 3)));
    }
  }
  return group;
}

}  // namespace

std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

std::string title_of(const TestSummary& test) {
  return test.held_out ? test.name + " (held out)" : test.name;
}

std::string parameter_text(const ParameterEstimate& si) {
  const ParameterEstimate estimate = in_key_unit(si);
  const model::ParameterInfo& info = model::info(si.id);
  return with_unit(fmt::format("{} = {}", info.name, format_with_error(estimate.value, estimate.std_error)),
                   info.unit);
}

std::string interval_text(const ParameterEstimate& si) {
  const ParameterEstimate estimate = in_key_unit(si);
  return interval_text(estimate.ci95_lower, estimate.ci95_upper);
}

int interval_digits(double lower, double upper) {
  const double width = upper - lower;
  if (!(width > 0.0 && std::isfinite(width))) return 4;
  const double largest = std::max(std::abs(lower), std::abs(upper));
  return std::clamp(static_cast<int>(std::ceil(std::log10(largest / width))) + 2, 2, 9);
}

std::string interval_text(double ci95_lower, double ci95_upper) {
  const double width = ci95_upper - ci95_lower;
  if (!std::isfinite(width)) return kMissing;
  const int shown = interval_digits(ci95_lower, ci95_upper);
  const std::string lower = format_number(ci95_lower, shown);
  const std::string upper = format_number(ci95_upper, shown);
  const std::size_t power = lower.find("×");
  if (power == std::string::npos || !upper.ends_with(lower.substr(power))) {
    return fmt::format("{} to {}", lower, upper);
  }
  return fmt::format("({} to {}){}", lower.substr(0, power), upper.substr(0, upper.find("×")),
                     lower.substr(power));
}

void add_parameter_verdicts(Page& page, const std::vector<ParameterEstimate>& estimates) {
  if (const auto texts = texts_with(estimates, Verdict::identified); !texts.empty()) {
    page.verdict(Tone::good, fmt::format("The data determine {}.", listed(texts)));
  }
  if (const auto texts = texts_with(estimates, Verdict::weak); !texts.empty()) {
    page.verdict(Tone::warning, fmt::format("Only weakly determined: {}.", listed(texts)));
  }
  std::vector<std::string> undetermined;
  for (const ParameterEstimate& estimate : estimates) {
    if (estimate.verdict != Verdict::undetermined) continue;
    undetermined.push_back(fmt::format("{} (95 % interval {}{}{})", parameter_text(estimate),
                                       interval_text(estimate), estimate.words.empty() ? "" : "; ",
                                       estimate.words));
  }
  if (!undetermined.empty()) {
    page.verdict(Tone::warning, fmt::format("These data do not determine {}: other values would do as well.",
                                            listed(undetermined)));
  }
}

void add_adequacy_verdict(Page& page, const FitResult& result, std::string_view tests) {
  const Group fitted = group_of(result, false);
  const Group held_out = group_of(result, true);
  const std::string limit = format_number(calibration::kAdequate, 2);
  std::string sentence =
      result.adequate
          ? fmt::format(
                "The model is adequate for the fitted {}: none is missed by more than {} times its noise "
                "(root mean square; {} is the limit, 1 as good as the noise allows).",
                tests, format_number(fitted.worst, 3), limit)
          : fmt::format(
                "The model is not adequate for the fitted {}: beyond {} times the noise (root mean square) "
                "are {}.",
                tests, limit, listed(fitted.missed));
  if (!held_out.names.empty()) {
    sentence +=
        held_out.missed.empty()
            ? fmt::format(" Held out and predicted to within {} times the noise: {}.",
                          format_number(held_out.worst, 3), listed(held_out.names))
            : fmt::format(" Held out and predicted less well than that: {}.", listed(held_out.missed));
  }
  const Tone tone = !result.adequate ? Tone::bad : held_out.missed.empty() ? Tone::good : Tone::warning;
  page.verdict(tone, std::move(sentence));
}

void add_warnings(Page& page, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) page.verdict(Tone::warning, warning + ".");
}

Table parameter_table(const std::vector<ParameterEstimate>& estimates, std::string caption,
                      Meanings meanings) {
  using enum Alignment;
  Table table{.caption = std::move(caption),
              .header = {"Parameter", "Value ± standard error", "95 % interval", "Unit", "Verdict", "Why"},
              .alignment = {left, right, right, left, left, left}};
  if (meanings == Meanings::shown) table.header.push_back("Meaning");
  for (const ParameterEstimate& si : estimates) {
    const ParameterEstimate estimate = in_key_unit(si);
    const model::ParameterInfo& info = model::info(si.id);
    table.rows.push_back({std::string(info.name), format_with_error(estimate.value, estimate.std_error),
                          interval_text(si), std::string(info.unit == "-" ? kMissing : info.unit),
                          std::string(calibration::name_of(estimate.verdict)), estimate.words});
    if (meanings == Meanings::shown) table.rows.back().emplace_back(info.meaning);
  }
  if (meanings == Meanings::shown) table.notes = {std::string(kVerdictNote)};
  return table;
}

Table correlation_table(const FitResult& result) {
  Table table{.caption = "Correlation of the fitted coordinates.",
              .header = {""},
              .alignment = {Alignment::left},
              .notes = {"Near +1 or −1 two quantities can hardly be told apart: one makes up for a change of "
                        "the other. Blue: positive, orange: negative, the deeper the closer to ±1."}};
  const std::vector<std::string> names = coordinate_names(result);
  if (names.size() < 2) return table;
  for (std::size_t i = 0; i < names.size(); ++i) {
    table.header.push_back(names[i]);
    table.alignment.push_back(Alignment::right);
    std::vector<std::string> row{names[i]};
    std::vector<std::optional<Rgb>> shades{std::nullopt};
    for (std::size_t j = 0; j < names.size(); ++j) {
      const double value = result.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const bool shown = j < i && std::isfinite(value);
      row.push_back(j > i ? "" : format_number(std::round(100.0 * value) / 100.0, 2));
      shades.push_back(shown ? std::optional(correlation_colour(value)) : std::nullopt);
    }
    table.rows.push_back(std::move(row));
    table.shades.push_back(std::move(shades));
  }
  return table;
}

std::vector<std::string> null_direction_sentences(const FitResult& result) {
  std::vector<std::string> sentences;
  for (const Eigen::VectorXd& direction : result.uncertainty.null_directions) {
    constexpr double kNoPart = 1e-3;
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < result.coordinates.size(); ++k) {
      const double part = direction[static_cast<Eigen::Index>(k)];
      if (std::abs(part) < kNoPart) continue;
      parts.push_back(
          fmt::format("{} by {}", coordinate_name(result.coordinates[k]), format_number(part, 3)));
    }
    sentences.push_back("The data do not see the following move: " + listed(parts) + ".");
  }
  return sentences;
}

Figure cost_figure(const FitResult& result) {
  Figure figure = trace_figure(result, [](const calibration::TracePoint& point) { return point.cost; });
  figure.y.label = "cost (half the sum of squares in units of noise)";
  figure.y.logarithmic = true;
  figure.caption = "Convergence: least cost so far against the number of evaluations.";
  return figure;
}

Figure parameter_figure(const FitResult& result, std::size_t free_index) {
  const calibration::Coordinate& coordinate = result.coordinates.at(free_index);
  Figure figure = trace_figure(result, [&](const calibration::TracePoint& point) {
    return quantity_at(coordinate, point.coordinates[free_index]);
  });
  figure.y.label = quantity_name(coordinate);
  figure.caption = fmt::format("{} at the least cost so far.", coordinate.name);
  return figure;
}

Table route_table(const FitResult& result, const std::vector<OptimiserResult>& further) {
  Table table{.caption = "How the answer was reached.", .header = {""}, .alignment = {Alignment::left}};
  auto routes = routes_of(result);
  for (const OptimiserResult& route : further) routes.push_back(&route);
  for (const OptimiserResult* route : routes) {
    table.header.push_back(route->route);
    table.alignment.push_back(Alignment::right);
  }
  const auto row = [&](std::string name, auto&& text) {
    std::vector<std::string> cells{std::move(name)};
    for (const OptimiserResult* route : routes) cells.push_back(text(*route));
    table.rows.push_back(std::move(cells));
  };
  constexpr int kDigits = 7;  // enough to see where routes part
  for (std::size_t k = 0; k < result.coordinates.size(); ++k) {
    row(quantity_name(result.coordinates[k]), [&](const OptimiserResult& route) {
      // a route that was stopped before it began has no place
      if (k >= route.coordinates.size()) return std::string(kMissing);
      return format_number(quantity_at(result.coordinates[k], route.coordinates[k]), kDigits);
    });
  }
  row("cost", [](const OptimiserResult& route) { return format_number(route.cost, kDigits); });
  row("evaluations", [](const OptimiserResult& route) { return fmt::format("{}", route.evaluations); });
  row("of them failed",
      [](const OptimiserResult& route) { return fmt::format("{}", route.failed_evaluations); });
  const auto counted = [](const OptimiserResult* route) { return route->simulations > 0; };
  if (std::any_of(routes.begin(), routes.end(), counted)) {
    row("simulations", [](const OptimiserResult& route) {
      return route.simulations > 0 ? fmt::format("{}", route.simulations) : std::string(kMissing);
    });
  }
  row("converged", [](const OptimiserResult& route) { return std::string(route.converged ? "yes" : "no"); });
  for (const OptimiserResult* route : routes) {
    table.notes.push_back(fmt::format("{} ended with: {}", route->route, route->termination));
  }
  if (result.check) {
    table.notes.push_back(
        fmt::format("The routes share the predictions, but not the search: they start at the same "
                    "point and end {} standard errors apart.",
                    format_number(result.disagreement, 2)));
  }
  return table;
}

std::vector<std::string> assumptions_on(const std::vector<std::string>& all, std::string_view subject) {
  std::vector<std::string> chosen;
  for (const std::string& text : all) {
    if (text.starts_with(subject)) chosen.push_back(text);
  }
  return chosen;
}

std::string bulleted(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "• " : "\n• ") + line;
  return text;
}

void add_data_note(Page& page, const datasets::Study& study) {
  if (!study.note.empty()) page.fact("About the data", study.note);
}

}  // namespace isotach::reports
