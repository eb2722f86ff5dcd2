// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/next_test_report.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/slump_map_section.hpp"

namespace isotach::reports {
namespace {

using calibration::CandidateRating;
using calibration::NextTest;
using calibration::Outlook;

constexpr double kPercent = 100.0;
constexpr std::size_t kDrawn = 4;    // candidates with an ellipse
constexpr std::size_t kSummary = 6;  // candidates on the first page

/// The standard error of ln I_v, in percent of I_v.
std::string I_v_text(const Outlook& outlook) {
  return std::isfinite(outlook.first) ? format_number(kPercent * outlook.first, 2) : "not held";
}

std::string C_1_text(const Outlook& outlook) {
  return std::isfinite(outlook.second) ? format_number(outlook.second, 2) : "not held";
}

std::string both_text(const Outlook& outlook) {
  return fmt::format("I_v to {}, C_1 to {}",
                     std::isfinite(outlook.first) ? I_v_text(outlook) + " %" : "no number",
                     std::isfinite(outlook.second) ? "± " + C_1_text(outlook) : "no number");
}

/// How much of a variance a test takes away, in percent.
std::string drop_text(double before, double after) {
  if (!std::isfinite(before) || !std::isfinite(after)) return kMissing;
  return format_number(kPercent * (1.0 - after * after / (before * before)), 2);
}

double value_of(const NextTest& next, Eigen::Index k) {
  const calibration::Coordinate& coordinate = next.coordinates[static_cast<std::size_t>(k)];
  return coordinate.quantity(coordinate.start);
}

Figure ellipse_figure(const NextTest& next) {
  Figure figure;
  figure.x = {.label = "I_v"};
  figure.y = {.label = "C_1"};
  figure.height_to_width = 0.7;
  for (const Ellipse& ellipse : ellipses_of(next)) {
    figure.series.push_back({.label = ellipse.name, .x = ellipse.I_v, .y = ellipse.C_1});
  }
  figure.series.push_back({.label = "present fit",
                           .style = SeriesStyle::discs,
                           .x = {value_of(next, next.interest.first)},
                           .y = {value_of(next, next.interest.second)},
                           .colour = palette_colour(6)});
  figure.caption =
      "95 % regions of I_v and C_1 together: as the study holds them now, and with one more test each. A "
      "region "
      "may reach below C_1 = 0, where no material is: it is that of the linearised problem.";
  return figure;
}

Figure bar_figure(const NextTest& next, bool I_v) {
  Figure figure;
  figure.x = {.label = "candidate, by rank"};
  figure.y = {.label = I_v ? "standard error of I_v (%)" : "standard error of C_1", .logarithmic = true};
  Series slumps{.label = "slump", .style = SeriesStyle::discs, .colour = palette_colour(0)};
  Series oedometers{.label = "oedometer", .style = SeriesStyle::discs, .colour = palette_colour(1)};
  double rank = 0.0;
  for (const std::size_t i : by_gain(next)) {
    const CandidateRating& candidate = next.candidates[i];
    Series& series = candidate.slump ? slumps : oedometers;
    series.x.push_back(++rank);
    series.y.push_back(I_v ? kPercent * candidate.with_present.first : candidate.with_present.second);
  }
  for (Series* series : {&slumps, &oedometers}) {
    if (!series->x.empty()) figure.series.push_back(std::move(*series));
  }
  const double now = I_v ? kPercent * next.present.first : next.present.second;
  if (std::isfinite(now)) {
    figure.markers.push_back({MarkerLine::Direction::horizontal, now, "present"});
  }
  figure.x.min = 0.0;
  figure.x.max = rank + 1.0;
  figure.caption =
      fmt::format("Standard error of {} with one more test, the candidates in the order of the table.",
                  I_v ? "I_v" : "C_1");
  return figure;
}

Table candidate_table(const NextTest& next, std::size_t most) {
  using enum Alignment;
  Table table{.caption = "Candidates by what they would add.",
              .header = {"", "Candidate", "I_v (%)", "C_1", "Gain", "I_v variance −%", "C_1 variance −%",
                         "Correlation", "Alone: I_v (%)", "C_1"},
              .alignment = {right, left, right, right, right, right, right, right, right, right}};
  std::size_t rank = 0;
  for (const std::size_t i : by_gain(next)) {
    if (rank == most) break;
    const CandidateRating& candidate = next.candidates[i];
    table.rows.push_back({fmt::format("{}", ++rank), candidate.name, I_v_text(candidate.with_present),
                          C_1_text(candidate.with_present),
                          format_number(calibration::gain(next.present, candidate.with_present), 2),
                          drop_text(next.present.first, candidate.with_present.first),
                          drop_text(next.present.second, candidate.with_present.second),
                          format_number(candidate.with_present.correlation, 2), I_v_text(candidate.alone),
                          C_1_text(candidate.alone)});
  }
  table.notes = {
      "Standard errors that the study's tests and the candidate leave together, I_v in percent of it. Gain: "
      "of ln "
      "det of the covariance of ln I_v and C_1 (D-optimality; 1.4 halves the area of their region). "
      "Alone: without the study's tests but for what they hold of all other parameters."};
  return table;
}

Table detail_table(const NextTest& next) {
  using enum Alignment;
  Table table{
      .caption = "What it would look like if all other parameters were known exactly.",
      .header = {"Test", "Values", "Directions held", "I_v (%)", "C_1", "Others known: I_v (%)", "C_1"},
      .alignment = {left, right, right, right, right, right, right}};
  table.rows.push_back({"the study's tests", kMissing, kMissing, I_v_text(next.present),
                        C_1_text(next.present), I_v_text(next.present_held), C_1_text(next.present_held)});
  for (const std::size_t i : by_gain(next)) {
    const CandidateRating& candidate = next.candidates[i];
    table.rows.push_back({candidate.name, fmt::format("{}", candidate.values),
                          fmt::format("{} of {}", candidate.directions, next.coordinates.size()),
                          I_v_text(candidate.with_present), C_1_text(candidate.with_present),
                          I_v_text(candidate.with_present_held), C_1_text(candidate.with_present_held)});
  }
  table.notes = {
      "Directions held: combinations of all parameters that the candidate's data alone determine to better "
      "than a "
      "factor of e. The last two columns are what holding the others would pretend."};
  return table;
}

Table held_table(const NextTest& next) {
  using enum Alignment;
  Table table{
      .caption = "The study's tests.",
      .header = {"Test", "Values", "Directions held", "Alone: I_v (%)", "C_1", "Without it: I_v (%)", "C_1"},
      .alignment = {left, right, right, right, right, right, right}};
  for (const calibration::HeldTest& test : next.tests) {
    table.rows.push_back({test.name, fmt::format("{}", test.values),
                          fmt::format("{} of {}", test.directions, next.coordinates.size()),
                          I_v_text(test.alone), C_1_text(test.alone), I_v_text(test.without),
                          C_1_text(test.without)});
  }
  table.rows.push_back({"all together", kMissing, kMissing, I_v_text(next.present), C_1_text(next.present),
                        kMissing, kMissing});
  return table;
}

Table programme_table(const NextTest& next, const calibration::ProgrammeRating& programme) {
  using enum Alignment;
  Table table{
      .caption = programme.name + ": what each test contributes.",
      .header = {"Test", "Alone: I_v (%)", "C_1", "Programme without it: I_v (%)", "C_1", "Loss of gain"},
      .alignment = {left, right, right, right, right, right}};
  for (std::size_t k = 0; k < programme.tests.size(); ++k) {
    const CandidateRating& test = next.candidates[programme.tests[k]];
    table.rows.push_back({test.name, I_v_text(test.alone), C_1_text(test.alone),
                          I_v_text(programme.without[k]), C_1_text(programme.without[k]),
                          format_number(programme.without[k].log_det - programme.alone.log_det, 2)});
  }
  table.rows.push_back(
      {"all", I_v_text(programme.alone), C_1_text(programme.alone), kMissing, kMissing, kMissing});
  table.rows.push_back({"all, with the study's tests", I_v_text(programme.with_present),
                        C_1_text(programme.with_present), kMissing, kMissing, kMissing});
  return table;
}

Table sequence_table(const NextTest& next) {
  using enum Alignment;
  Table table{.caption = "One after another.",
              .header = {"", "Test", "I_v (%)", "C_1", "Correlation", "Gain"},
              .alignment = {right, left, right, right, right, right}};
  table.rows.push_back({"", "present", I_v_text(next.present), C_1_text(next.present),
                        format_number(next.present.correlation, 2), kMissing});
  Outlook before = next.present;
  std::size_t step = 0;
  for (const calibration::SequenceStep& one : next.sequence) {
    table.rows.push_back({fmt::format("{}", ++step), next.candidates[one.candidate].name, I_v_text(one.after),
                          C_1_text(one.after), format_number(one.after.correlation, 2),
                          format_number(calibration::gain(before, one.after), 2)});
    before = one.after;
  }
  table.notes = {
      "Each is the best once those before it are made; a test may come again. The list ends where "
      "none gains 0.02."};
  return table;
}

void add_summary(Page& page, const NextTest& next) {
  const std::vector<std::size_t> order = by_gain(next);
  const std::size_t failed = next.candidates.size() - order.size();
  if (order.empty()) {
    page.verdict(Tone::bad, "No candidate could be rated.");
  } else {
    const CandidateRating& best = next.candidates[order.front()];
    page.verdict(next.sequence.empty() ? Tone::plain : Tone::good,
                 fmt::format("Make next: {}. It would leave {}.", best.name, both_text(best.with_present)));
  }
  page.verdict(Tone::plain, fmt::format("The study's tests leave {}.", both_text(next.present)));
  if (next.pair) {
    const auto [first, second] = *next.pair;
    const std::string& name = next.candidates[first].name;
    page.verdict(Tone::plain,
                 fmt::format("The best two together: {}, which leave {}.",
                             first == second ? name + ", made twice"
                                             : fmt::format("{} and {}", name, next.candidates[second].name),
                             both_text(next.after_pair)));
  }
  for (const calibration::ProgrammeRating& programme : next.programmes) {
    page.verdict(Tone::plain, fmt::format("{}, {} tests: alone {}; with the study's {}.", programme.name,
                                          programme.tests.size(), both_text(programme.alone),
                                          both_text(programme.with_present)));
  }
  if (failed > 0) {
    page.verdict(Tone::warning,
                 fmt::format("{} of {} candidates could not be simulated; they are listed below.", failed,
                             next.candidates.size()));
  }
  page.fact("Candidates", fmt::format("{}", next.candidates.size()));
  page.fact("Simulations", fmt::format("{}", next.runs.total()));
}

std::string nuisances_of(const NextTest& next) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < next.coordinates.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (i != next.interest.first && i != next.interest.second) names.push_back(next.coordinates[k].name);
  }
  return names.empty() ? "nothing else" : listed(names);
}

void add_grounds(Page& page, const NextTest& next) {
  page.section("What the numbers rest on");
  page.paragraph(fmt::format(
      "The study's material is taken for the present fit, and all tests are linearised there. Found along "
      "with I_v and C_1: {}, as the study's tests hold them, and by what other cells, points and water would "
      "do to all outlines, each change of the numerics with an amplitude of unit variance. {}What is not in "
      "this list, as the friction angle and the void ratios, is taken as known. Whether the model is right "
      "is not asked.",
      nuisances_of(next),
      next.reference_rate > 0.0
          ? fmt::format(
                "D_r follows from the others: it is the viscous rate of steady oedometric compression at "
                "{} 1/s. ",
                format_number(next.reference_rate, 3))
          : std::string()));
  page.paragraph(
      "Outlines of candidates have the noise of the study's first fitted slump test and its spacing of "
      "points; a "
      "mud given by its strength has the void ratio that it means at the study's material.");
  if (next.stress_noise) {
    page.paragraph(fmt::format(
        "Oedometer candidates have the noise of the study's noisiest channel of stress: {} % of the stress, "
        "correlation {} of neighbouring readings. Each is read 200 times unless its entry says otherwise.",
        format_number(kPercent * *next.stress_noise, 2), format_number(next.stress_correlation, 2)));
  }
  add_simulation_error(page, next.simulation_error);
  Table failures{.caption = "Candidates that could not be rated.", .header = {"Candidate", "Why"}};
  for (const CandidateRating& candidate : next.candidates) {
    if (!candidate.failure.empty()) failures.rows.push_back({candidate.name, candidate.failure});
  }
  if (!failures.rows.empty()) page.table(std::move(failures));
}

}  // namespace

std::vector<std::size_t> by_gain(const NextTest& next) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < next.candidates.size(); ++i) {
    if (next.candidates[i].failure.empty()) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return next.candidates[a].with_present.log_det < next.candidates[b].with_present.log_det;
  });
  return order;
}

std::vector<Ellipse> ellipses_of(const NextTest& next) {
  constexpr double kRadius = 2.4477;  // sqrt of the 95 % quantile of chi-squared with two degrees
  constexpr int kPoints = 120;
  const double log_I_v = std::log(value_of(next, next.interest.first));
  const double C_1 = value_of(next, next.interest.second);
  std::vector<Ellipse> all;
  const auto add = [&](const std::string& name, const Outlook& outlook) {
    if (!std::isfinite(outlook.log_det)) return;
    const Eigen::Matrix2d factor = outlook.covariance.llt().matrixL();
    Ellipse ellipse{name, {}, {}};
    for (int i = 0; i <= kPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kPoints;
      const Eigen::Vector2d d = kRadius * factor * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      ellipse.I_v.push_back(std::exp(log_I_v + d[0]));
      ellipse.C_1.push_back(C_1 + d[1]);
    }
    all.push_back(std::move(ellipse));
  };
  add("present", next.present);
  const std::vector<std::size_t> order = by_gain(next);
  for (std::size_t k = 0; k < std::min(order.size(), kDrawn); ++k) {
    const CandidateRating& candidate = next.candidates[order[k]];
    add(candidate.name, candidate.with_present);
  }
  if (next.pair) add("the best two", next.after_pair);
  return all;
}

Page next_test_report(const RunInfo& run, const datasets::Study& study, const NextTest& next) {
  Page page("Which test next", subtitle(run));
  add_summary(page, next);
  add_data_note(page, study);
  std::vector<std::string> warnings = run.warnings;
  warnings.insert(warnings.end(), next.warnings.begin(), next.warnings.end());
  add_warnings(page, warnings);
  page.table(candidate_table(next, kSummary));
  page.section("Candidates");
  page.figure(ellipse_figure(next));
  page.table(candidate_table(next, next.candidates.size()));
  page.figures(bar_figure(next, true), bar_figure(next, false));
  page.section("Several tests");
  page.table(sequence_table(next));
  for (const calibration::ProgrammeRating& programme : next.programmes) {
    page.table(programme_table(next, programme));
  }
  page.section("What is held, and what holding others would pretend");
  page.table(held_table(next));
  page.table(detail_table(next));
  add_grounds(page, next);
  return page;
}

}  // namespace isotach::reports
