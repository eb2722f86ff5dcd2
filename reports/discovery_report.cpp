// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/discovery_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/limits.hpp"
#include "reports/discovery_parts.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/slump_discovery_report.hpp"
#include "reports/wandering_section.hpp"

namespace isotach::reports {
namespace {

using discovery::Discovery;
using discovery::Trial;

constexpr double kKilopascal = 1e3;
constexpr std::size_t kStagesOnFirstPage = 6;

std::string number(double value) {
  return format_number(value, 3);
}

std::string values_of(const discovery::Candidate& candidate) {
  return reports::values_of(candidate.added, candidate.fit.effects);
}

std::string gap_words(const Discovery& found, const Trial& after) {
  return reports::gap_words({"The gap", "the noise", "readings"}, found.base.gap, after.gap, found.best_wrong,
                            found.smoother);
}

/// How far the best explanation goes that could not be named.
void add_best_unnamed(Page& page, const Discovery& found) {
  const Trial& best = found.trials.front();
  if (best.adequacy.meets_noise) {
    page.verdict(Tone::plain,
                 fmt::format("To within the noise that the study states the data are consistent with {}; but "
                             "it does not meet the conditions of a name.",
                             name_of(best.candidate)));
  }
  page.verdict(Tone::plain, gap_words(found, best));
  if (found.next) page.verdict(Tone::plain, next_words(*found.next));
}

void add_verdict(Page& page, const Discovery& found) {
  using discovery::Verdict;
  switch (found.verdict) {
    case Verdict::adequate:
      page.verdict(
          Tone::good,
          fmt::format("The model suffices: every test and stage is met to within its noise, and no "
                      "effect of the catalogue improves the fit more than noise would ({}), nor does "
                      "a constant or a reading that wanders ({}).",
                      discovery::p_words(found.p_value), discovery::p_words(found.wandering.p_value)));
      return;
    case Verdict::named: {
      const Trial& best = found.trials[*found.chosen];
      page.verdict(Tone::warning, fmt::format("The model lacks {}: the data are consistent with {}{}.",
                                              described(best.candidate.added), values_of(best.candidate),
                                              intervals_words(found.amplitudes)));
      page.verdict(Tone::good, gap_words(found, best));
      return;
    }
    case Verdict::ambiguous: {
      std::string names;
      for (const std::size_t k : found.equivalent) {
        if (!names.empty()) names += "; ";
        names += name_of(found.trials[k].candidate);
      }
      page.verdict(
          Tone::warning,
          found.equivalent.size() > 1
              ? fmt::format("The model lacks something that these tests cannot tell apart: {}.", names)
              : fmt::format("The model lacks something: the data are consistent with {}, and with "
                            "nothing else of the catalogue as well, but there is no second test to "
                            "try that on.",
                            names));
      if (found.next) page.verdict(Tone::plain, next_words(*found.next));
      return;
    }
    case Verdict::unknown:
      page.verdict(
          Tone::bad,
          "The model does not suffice, and no effect of the catalogue, nor two of them, can be named "
          "for it: see where it fails.");
      if (!found.trials.empty()) add_best_unnamed(page, found);
      page.verdict(Tone::plain, wander_words(found.wandering));
      return;
  }
}

Table disagreement_table(const Discovery& found, std::size_t most) {
  Table table{.caption = "Where the base disagrees, the worst first.",
              .header = {"test", "stage", "from (s)", "to (s)", "from (kPa)", "to (kPa)", "rms/noise",
                         "mean/noise", "score", "explained"},
              .alignment = {Alignment::left, Alignment::left, Alignment::right, Alignment::right,
                            Alignment::right, Alignment::right, Alignment::right, Alignment::right,
                            Alignment::right, Alignment::right}};
  table.notes.push_back(
      "Score: root of the sum of squared residuals beyond what noise would give, in units of noise. "
      "Explained: root of the sum of squares of what the best explanation changes there and the base's "
      "parameters cannot; where there is an explanation it ranks the stages, for it is nearly free of "
      "noise.");
  for (std::size_t k = 0; k < std::min(most, found.disagreement.size()); ++k) {
    const discovery::Disagreement& place = found.disagreement[k];
    table.rows.push_back({place.test + (place.held_out ? ", held out" : ""), place.stage.stage,
                          number(place.stage.from_time), number(place.stage.to_time),
                          number(place.stage.from_stress / kKilopascal),
                          number(place.stage.to_stress / kKilopascal), number(place.stage.rms_over_noise),
                          number(place.stage.mean_over_noise), number(place.score),
                          place.explained ? number(*place.explained) : kMissing});
  }
  return table;
}

Table trials_table(const Discovery& found) {
  Table table{
      .caption = "Explanations that were fitted, the best first.",
      .header = {"effects", "parameters", "BIC above the best", "gap", "gap, held out", "leaves nothing"},
      .alignment = {Alignment::left, Alignment::left, Alignment::right, Alignment::right, Alignment::right,
                    Alignment::left}};
  const double least = found.trials.empty() ? found.base.candidate.bic : found.trials.front().candidate.bic;
  const auto row = [&](const Trial& trial) {
    table.rows.push_back({name_of(trial.candidate), values_of(trial.candidate),
                          number(trial.candidate.bic - least), number(trial.gap.fitted),
                          std::isfinite(trial.gap.held_out) ? number(trial.gap.held_out) : kMissing,
                          trial.adequate ? "yes" : "no"});
  };
  for (const Trial& trial : found.trials) row(trial);
  row(found.base);
  table.notes.push_back(
      "Gap: root mean square of residuals over the noise that the study states; 1 is as good as the noise "
      "allows. BIC by one noise for all, that of the best.");
  return table;
}

Table score_table(const Discovery& found) {
  Table table{
      .caption = "What each effect would do, at zero of its amplitude.",
      .header = {"effect", "score", "absorbed by the base (%)", "enters", "with height"},
      .alignment = {Alignment::left, Alignment::right, Alignment::right, Alignment::left, Alignment::left}};
  for (std::size_t k = 0; k < found.scores.effects.size(); ++k) {
    const effects::Effect& effect = *found.scores.effects[k];
    double absorbed = 1.0;
    for (const discovery::Signature& signature : found.scores.signatures) {
      if (signature.effect == &effect) absorbed = std::min(absorbed, signature.absorbed);
    }
    table.rows.push_back({std::string(effect.name), number(std::sqrt(found.scores.best[k])),
                          number(100.0 * absorbed), std::string(effects::name_of(effect.seam)),
                          fmt::format("H^{}", effect.height_exponent)});
  }
  table.notes.push_back(
      "Score: standard deviations of noise by which the residuals lie along the effect's signature, once "
      "what the base's parameters can do is taken from it.");
  return table;
}

Table likeness_table(const Discovery& found) {
  Table table{.caption = "How alike the signatures are (cosines, with what the base can do taken away)."};
  table.header.emplace_back("");
  for (const effects::Effect* effect : found.scores.effects) table.header.emplace_back(effect->name);
  for (const effects::Effect* a : found.scores.effects) {
    std::vector<std::string> row{std::string(a->name)};
    for (const effects::Effect* b : found.scores.effects) {
      row.push_back(fmt::format("{:.2f}", likeness(found.scores, *a, *b)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Residuals of one test in time, before and after.
Figure residuals_figure(const Discovery& found, std::size_t test) {
  const calibration::OedometerFit& before = found.base.candidate.fit;
  const experiments::OedometerExperiment& experiment = *before.experiments[test];
  Figure figure;
  figure.caption = fmt::format(
      "{}{}: residuals of the base{}.", experiment.name(), experiment.held_out() ? " (held out)" : "",
      found.trials.empty() ? "" : " and with " + name_of(found.trials.front().candidate));
  figure.x = {.label = "time (h)"};
  figure.y = {.label = "residual / noise"};
  figure.height_to_width = 0.5;
  std::vector<double> hours;
  for (const experiments::ComparedValue& value : experiment.values()) {
    hours.push_back(experiment.row_of(value).time / 3600.0);
  }
  figure.series.push_back({.label = "base",
                           .style = SeriesStyle::dots,
                           .x = hours,
                           .y = before.evaluation.scaled_residuals[test]});
  if (!found.trials.empty()) {
    const calibration::OedometerFit& after = found.trials.front().candidate.fit;
    for (std::size_t i = 0; i < after.experiments.size(); ++i) {  // it may lack one that is held out
      if (after.experiments[i]->name() != experiment.name()) continue;
      figure.series.push_back({.label = name_of(found.trials.front().candidate),
                               .style = SeriesStyle::dots,
                               .x = hours,
                               .y = after.evaluation.scaled_residuals[i]});
    }
  }
  figure.markers = {{MarkerLine::Direction::horizontal, 2.0, ""},
                    {MarkerLine::Direction::horizontal, -2.0, ""}};
  return figure;
}

void add_explanations(Page& page, const Discovery& found) {
  page.table(trials_table(found));
  add_conditions(page, found.conditions);
  add_not_tried(page, found.not_tried);
}

}  // namespace

void add_discovery(Page& page, const Discovery& found) {
  add_verdict(page, found);
  page.section("Discovery: oedometer tests");
  page.paragraph(
      "Whether the model suffices for the oedometer tests, and which effect of the catalogue is missing if "
      "it does not; isotach discover has the whole of it.");
  page.table(disagreement_table(found, kStagesOnFirstPage));
  add_explanations(page, found);
}

namespace {

void add_evidence(Page& page, const Discovery& found) {
  page.fact("Verdict", std::string(name_of(found.verdict)));
  page.fact("Noise alone would let some effect improve the fit as much", discovery::p_words(found.p_value));
  page.table(disagreement_table(found, kStagesOnFirstPage));
  const auto worst =
      std::find_if(found.base.candidate.fit.experiments.begin(), found.base.candidate.fit.experiments.end(),
                   [&](const auto& test) {
                     return found.disagreement.empty() || test->name() == found.disagreement.front().test;
                   });
  if (worst != found.base.candidate.fit.experiments.end()) {
    page.figure(residuals_figure(
        found, static_cast<std::size_t>(worst - found.base.candidate.fit.experiments.begin())));
  }
  page.section("Explanations");
  add_explanations(page, found);
  page.section("Scores");
  page.table(score_table(found));
  page.table(likeness_table(found));
  add_wandering(
      page, found.wandering,
      "One constant of the law, or one reading, at a time is let wander as a polygon over the time of each "
      "test or over stress, beside the base's parameters, to first order. A gap that closes when the stress "
      "read wanders over stress points at the load cell; one that closes with D_r over time, at the soil. "
      "A constant part is the base's own, where it is free.");
  page.section("Where");
  page.table(disagreement_table(found, found.disagreement.size()));
  for (std::size_t i = 0; i < found.base.candidate.fit.experiments.size(); ++i) {
    page.figure(residuals_figure(found, i));
  }
  page.section("How it was decided");
  page.paragraph(fmt::format(
      "The base is rejected where a test or stage is missed by more than its stated noise, or where noise "
      "alone would let some effect improve the fit as much, or some slot wander as far, in less than {} of "
      "cases (parametric bootstrap of the largest, {} replicates). A name needs: a model that then meets "
      "every test and stage and calls for "
      "nothing more "
      "(p >= {}), a BIC lower than any other's by {}, an amplitude within its bounds, and predictions of "
      "tests left out of the fit that are no worse than the base's (log predictive density, which weighs how "
      "well "
      "the other tests hold the parameters). Tests held out take no part in any of it.",
      discovery::kRejects, discovery::kReplicates, discovery::kLeavesNothing, discovery::kMargin));
}

}  // namespace

Page discovery_report(const RunInfo& run, const datasets::Study& study, const Discoveries& found) {
  Page page("Discovery", subtitle(run));
  if (found.oedometer) add_verdict(page, *found.oedometer);
  add_warnings(page, run.warnings);
  add_data_note(page, study);
  if (found.oedometer) add_evidence(page, *found.oedometer);
  if (found.slump) add_slump_discovery(page, *found.slump);
  return page;
}

}  // namespace isotach::reports
