// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/slump_discovery_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/limits.hpp"
#include "reports/discovery_parts.hpp"
#include "reports/fit_sections.hpp"
#include "reports/json_number.hpp"
#include "reports/number.hpp"
#include "reports/wandering_section.hpp"

namespace isotach::reports {
namespace {

using discovery::SlumpCandidate;
using discovery::SlumpDiscovery;
using discovery::SlumpTrial;
using nlohmann::ordered_json;

constexpr double kMillimetre = 1e-3;
constexpr std::size_t kPlacesShown = 12;
constexpr std::size_t kOutlinesShown = 3;
constexpr std::size_t kTestsShown = 2;

std::string three(double value) {
  return format_number(value, 3);
}

std::string values_of(const SlumpCandidate& candidate) {
  return reports::values_of(candidate.added, candidate.effects);
}

std::string gap_words(const SlumpDiscovery& found) {
  return reports::gap_words({"The gap of the outlines", "their noise", "points"}, found.base.gap,
                            found.trials.front().gap, found.best_wrong, found.smoother);
}

/// What becomes of the place where the explanation shows most.
std::string plainest_place_words(const SlumpDiscovery& found) {
  if (found.disagreement.empty()) return {};
  const discovery::SlumpDisagreement& place = found.disagreement.front();
  if (!std::isfinite(place.mean_by_best)) return {};
  return fmt::format(
      " Where this shows most, {} at the {} between {} and {} s, the mean distance of the outlines goes from "
      "{} to {} mm.",
      place.test, name_of(place.zone), three(place.from), three(place.to), three(place.mean / kMillimetre),
      three(place.mean_by_best / kMillimetre));
}

void add_verdict(Page& page, const SlumpDiscovery& found) {
  using discovery::Verdict;
  switch (found.verdict) {
    case Verdict::adequate:
      page.verdict(
          Tone::good,
          found.by_gain
              ? "Slumps: the model suffices. Every test is met to within its noise, and no effect of "
                "the catalogue improves the fit more than noise would."
              : "Slumps: the model suffices. Every test is met to within its noise and the error of "
                "the simulations; finer cells may tell more.");
      return;
    case Verdict::named: {
      const SlumpTrial& best = found.trials[*found.chosen];
      page.verdict(Tone::warning,
                   fmt::format("Slumps: the model lacks {}: the data are consistent with {}{}.",
                               described(best.candidate.added), values_of(best.candidate),
                               intervals_words(found.amplitudes)));
      page.verdict(Tone::good, gap_words(found) + plainest_place_words(found));
      return;
    }
    case Verdict::ambiguous: {
      std::string names;
      for (const std::size_t k : found.equivalent) {
        names += (names.empty() ? "" : "; ") + name_of(found.trials[k].candidate);
      }
      page.verdict(
          Tone::warning,
          fmt::format("Slumps: the model lacks something that these tests cannot tell apart: {}.", names));
      if (found.next) page.verdict(Tone::plain, next_words(*found.next));
      return;
    }
    case Verdict::unknown:
      page.verdict(Tone::bad,
                   "Slumps: the model does not suffice, and no effect of the catalogue, nor two of them, can "
                   "be named for it: see where it fails.");
      if (!found.trials.empty()) page.verdict(Tone::plain, gap_words(found));
      if (found.wandering && !found.wandering->slots.empty()) {
        page.verdict(Tone::plain, wander_words(*found.wandering));
      }
      return;
  }
}

std::string millimetres_or_none(double metres) {
  return std::isfinite(metres) ? three(metres / kMillimetre) : kMissing;
}

Table place_table(const SlumpDiscovery& found) {
  Table table{
      .caption = "Where the base's outlines disagree, the worst first.",
      .header = {"test", "zone", "mould", "from (s)", "to (s)", "measured further out by (mm)",
                 "than with the best explanation (mm)", "score", "explained"},
      .alignment = {Alignment::left, Alignment::left, Alignment::left, Alignment::right, Alignment::right,
                    Alignment::right, Alignment::right, Alignment::right, Alignment::right}};
  table.notes.push_back(
      "Zones by length from the toe: toe to a quarter, top beyond seven tenths. Score: root of the sum of "
      "squared distances beyond what noise would give, in units of noise. Explained: root of the sum of "
      "squares of what the best explanation changes there, in units of the noise and of what simulations are "
      "unsure of; where there is an explanation it ranks the places, for it is nearly free of noise.");
  for (std::size_t k = 0; k < std::min(kPlacesShown, found.disagreement.size()); ++k) {
    const discovery::SlumpDisagreement& place = found.disagreement[k];
    table.rows.push_back({place.test + (place.held_out ? ", held out" : ""), std::string(name_of(place.zone)),
                          place.lifting ? "rising" : "gone", three(place.from), three(place.to),
                          three(place.mean / kMillimetre), millimetres_or_none(place.mean_by_best),
                          three(place.score), place.explained ? three(*place.explained) : kMissing});
  }
  return table;
}

Table trial_table(const SlumpDiscovery& found) {
  Table table{.caption = "Explanations of the outlines that were fitted, the best first.",
              .header = {"effects", "parameters", "I_v", "C_1", "BIC above the best", "gap", "gap, held out",
                         "leaves nothing"},
              .alignment = {Alignment::left, Alignment::left, Alignment::right, Alignment::right,
                            Alignment::right, Alignment::right, Alignment::right, Alignment::left}};
  const double least = found.trials.empty() ? found.base.candidate.bic : found.trials.front().candidate.bic;
  const auto row = [&](const SlumpTrial& trial) {
    const SlumpCandidate& candidate = trial.candidate;
    table.rows.push_back({name_of(candidate), values_of(candidate), three(candidate.parameters->I_v()),
                          three(candidate.parameters->C_1()), three(candidate.bic - least),
                          three(trial.gap.fitted),
                          std::isfinite(trial.gap.held_out) ? three(trial.gap.held_out) : kMissing,
                          trial.adequate ? "yes" : "no"});
  };
  for (const SlumpTrial& trial : found.trials) row(trial);
  row(found.base);
  table.notes.push_back(
      "Gap: root mean square of distances between outlines, decorrelated, over their noise and the error of "
      "the simulations; 1 is as good as these allow. Held-out tests were simulated for the base and the best "
      "only. I_v and C_1 were fitted with each.");
  return table;
}

Table signature_table(const SlumpDiscovery& found) {
  Table table{.caption = "What each effect would do to the outlines, at its typical strength.",
              .header = {"effect", "score", "absorbed by the base (%)", "strength called for (typical ones)"},
              .alignment = {Alignment::left, Alignment::right, Alignment::right, Alignment::right}};
  for (const discovery::SlumpSignature& one : found.signatures) {
    table.rows.push_back({std::string(one.effect->name), three(one.signature.z),
                          three(100.0 * one.signature.absorbed), three(one.amplitude)});
  }
  table.notes.push_back(
      "Score: standard deviations by which the residuals lie along the effect's signature, once what the "
      "base's parameters can do is taken from it; negative where the effect would have to act the other way "
      "round.");
  return table;
}

Table likeness_table(const SlumpDiscovery& found) {
  Table table{.caption = "How alike the signatures are (cosines, with what the base can do taken away)."};
  table.header.emplace_back("");
  for (const auto& one : found.signatures) table.header.emplace_back(one.effect->name);
  for (const auto& a : found.signatures) {
    std::vector<std::string> row{std::string(a.effect->name)};
    for (const auto& b : found.signatures) {
      row.push_back(fmt::format("{:.2f}", a.signature.unit.dot(b.signature.unit)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Series line_of(const mpm::Outline& outline, std::string label, SeriesStyle style) {
  Series series{.label = std::move(label), .style = style};
  for (const mpm::OutlinePoint& point : outline.points) {
    series.x.push_back(point.r / kMillimetre);
    series.y.push_back(point.z / kMillimetre);
  }
  return series;
}

/// Outlines of a test at one time: measured, by the base, by the best explanation.
Figure outline_figure(const SlumpDiscovery& found, std::size_t test, std::size_t outline) {
  const experiments::SlumpExperiment& experiment = *found.base.candidate.tests[test];
  const datasets::Outline& measured = experiment.test().outlines[outline];
  Figure figure;
  figure.caption = fmt::format("{} after {} s{}.", experiment.name(), three(measured.time),
                               experiment.held_out() ? ", held out" : "");
  figure.x = {.label = "r (mm)"};
  figure.y = {.label = "z (mm)"};
  figure.equal_aspect = true;
  Series points{.label = "measured", .style = SeriesStyle::dots};
  for (const datasets::OutlinePoint& point : measured.points) {
    points.x.push_back(point.r / kMillimetre);
    points.y.push_back(point.z / kMillimetre);
  }
  figure.series.push_back(std::move(points));
  figure.series.push_back(line_of(found.base.simulations[test].outlines[outline], "base", SeriesStyle::line));
  if (!found.trials.empty() && !found.trials.front().simulations[test].outlines.empty()) {
    figure.series.push_back(line_of(found.trials.front().simulations[test].outlines[outline],
                                    name_of(found.trials.front().candidate), SeriesStyle::line));
  }
  return figure;
}

/// The tests that the base misses most, at some times.
void add_outlines(Page& page, const SlumpDiscovery& found) {
  std::vector<std::string> shown;
  for (const discovery::SlumpDisagreement& place : found.disagreement) {
    if (shown.size() == kTestsShown) break;
    if (std::find(shown.begin(), shown.end(), place.test) != shown.end()) continue;
    shown.push_back(place.test);
    const auto& tests = found.base.candidate.tests;
    const auto at = std::find_if(tests.begin(), tests.end(),
                                 [&](const auto& test) { return test->name() == place.test; });
    const auto test = static_cast<std::size_t>(at - tests.begin());
    const std::size_t outlines = (*at)->test().outlines.size();
    std::vector<Figure> figures;
    for (std::size_t k = 0; k < std::min(kOutlinesShown, outlines); ++k) {
      figures.push_back(
          outline_figure(found, test, k * (outlines - 1) / std::max<std::size_t>(1, kOutlinesShown - 1)));
    }
    page.figures(std::move(figures));
  }
}

ordered_json trial_json(const SlumpTrial& trial) {
  const SlumpCandidate& candidate = trial.candidate;
  return {{"effects", names_json(candidate.added)},
          {"effect_parameters", values_json(candidate.added, candidate.effects)},
          {"I_v", json_number(candidate.parameters->I_v())},
          {"C_1", json_number(candidate.parameters->C_1())},
          {"bic", json_number(candidate.bic)},
          {"chi_squared", json_number(candidate.chi_squared)},
          {"gap", json_number(trial.gap.fitted)},
          {"held_out_gap", json_number(trial.gap.held_out)},
          {"adequate", trial.adequate}};
}

}  // namespace

void add_slump_discovery(Page& page, const SlumpDiscovery& found) {
  add_verdict(page, found);
  for (const std::string& warning : found.warnings) page.verdict(Tone::bad, "Slumps: " + warning + ".");
  page.section("Discovery: slump tests");
  page.paragraph(fmt::format(
      "The base was fitted to the tests that are not held out, {} simulations in all. It is rejected where a "
      "test is missed by more than {} times its noise, the error of the simulations included{}; then effects "
      "are fitted, and a name needs what the conditions below say. Tests held out take no part in any of it.",
      found.simulations, calibration::kAdequate,
      found.by_gain
          ? fmt::format(", or where noise would let some effect gain as much as one does in less than "
                        "{} of cases (simulations are corrected to reference numerics)",
                        discovery::kRejects)
          : " (by reference numerics, which the study does not name, smaller misfits would tell)"));
  page.table(place_table(found));
  add_outlines(page, found);
  page.table(trial_table(found));
  add_conditions(page, found.conditions);
  page.table(signature_table(found));
  page.table(likeness_table(found));
  if (found.wandering) {
    add_wandering(
        page, *found.wandering,
        "The adhesion of the wall, the slip length of the base or the strength of the mud is let wander as a "
        "polygon over the time of each test, strength over the height in the fill or over strain rate too, "
        "beside the base's parameters, to first order. A gap that closes when the wall wanders is the "
        "mould's; one that closes when strength does, the material's. Negative adhesions and lengths say "
        "that the other way round would be wanted.");
  }
  add_not_tried(page, found.not_tried);
}

ordered_json discovery_json(const SlumpDiscovery& found) {
  ordered_json json;
  json["verdict"] = std::string(name_of(found.verdict));
  const SlumpTrial& answer = found.answer();
  json["effects"] = names_json(answer.candidate.added);
  json["equivalent"] = ordered_json::array();
  for (const std::size_t k : found.equivalent) {
    json["equivalent"].push_back(names_json(found.trials[k].candidate.added));
  }
  json["effect_parameters"] = values_json(answer.candidate.added, answer.candidate.effects);
  json["amplitude_intervals"] = intervals_json(found.amplitudes);
  json["gap"] = gap_json(found.base.gap, answer.gap, found.best_wrong, found.smoother);
  json["p_value"] = json_number(found.p_value);
  json["disagreement"] = ordered_json::array();
  for (const discovery::SlumpDisagreement& place : found.disagreement) {
    json["disagreement"].push_back(
        {{"experiment", place.test},
         {"held_out", place.held_out},
         {"zone", std::string(name_of(place.zone))},
         {"mould", place.lifting ? "rising" : "gone"},
         {"from", json_number(place.from)},
         {"to", json_number(place.to)},
         {"mean_mm", json_number(place.mean / kMillimetre)},
         {"mean_by_best_mm", json_number(place.mean_by_best / kMillimetre)},
         {"score", json_number(place.score)},
         {"explained", place.explained ? json_number(*place.explained) : ordered_json(nullptr)}});
  }
  json["conditions"] = conditions_json(found.conditions);
  json["base"] = trial_json(found.base);
  json["trials"] = ordered_json::array();
  for (const SlumpTrial& trial : found.trials) json["trials"].push_back(trial_json(trial));
  json["scores"] = ordered_json::array();
  for (const discovery::SlumpSignature& one : found.signatures) {
    json["scores"].push_back({{"effect", std::string(one.effect->name)},
                              {"score", json_number(one.signature.z)},
                              {"absorbed", json_number(one.signature.absorbed)}});
  }
  if (found.wandering) json["wandering"] = wandering_json(*found.wandering);
  json["next_test"] = next_json(found.next);
  json["simulations"] = found.simulations;
  json["warnings"] = found.warnings;
  return json;
}

}  // namespace isotach::reports
