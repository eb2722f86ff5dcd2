// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Sentences and facts of the first page.
#include "reports/oedometer_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;
using calibration::StageCheck;
using calibration::TestCheck;
using calibration::TestSummary;

constexpr std::size_t kNamedStages = 3;  // of a sentence; the table of stages has them all

std::string times_noise(double rms_over_noise) {
  return fmt::format("{} × noise", format_number(rms_over_noise, 3));
}

/// "load 2 (2.4 × noise, model above)".
std::string stage_text(const StageCheck& stage) {
  // a mean within a third of the scatter is no side
  const double share = stage.mean_over_noise / stage.rms_over_noise;
  constexpr double kOneSided = 0.33;
  const char* side = share > kOneSided    ? "model above"
                     : share < -kOneSided ? "model below"
                                          : "model above and below";
  return fmt::format("{} ({}, {})", stage.stage, times_noise(stage.rms_over_noise), side);
}

/// The missed stages of one test, the worst first, or nothing.
std::string missed_stages(const TestCheck& check) {
  std::vector<StageCheck> missed;
  for (const StageCheck& stage : check.stages) {
    if (stage.misfit) missed.push_back(stage);
  }
  std::stable_sort(missed.begin(), missed.end(), [](const StageCheck& a, const StageCheck& b) {
    return a.rms_over_noise > b.rms_over_noise;
  });
  std::vector<std::string> texts;
  for (const StageCheck& stage : missed) {
    if (texts.size() == kNamedStages) break;
    texts.push_back(stage_text(stage));
  }
  if (missed.size() > kNamedStages) texts.push_back(fmt::format("{} more", missed.size() - kNamedStages));
  return listed(texts);
}

double worst_of(const OedometerFit& fit, bool held_out) {
  double worst = 0.0;
  for (const TestSummary& test : fit.result.tests) {
    if (test.held_out == held_out) worst = std::max(worst, test.rms_over_noise);
  }
  return worst;
}

std::string agreement_text(const OedometerFit& fit) {
  const calibration::FitResult& result = fit.result;
  std::vector<std::string> parts;
  if (result.check) {
    parts.push_back(fmt::format("{} ends {} standard errors from {}", result.check->route,
                                format_number(result.disagreement, 2), result.main.route));
  }
  if (fit.assessment) {
    for (const calibration::OptimiserResult& search : fit.assessment->global_searches) {
      parts.push_back(fmt::format("{} at {} of cost from it", search.route,
                                  format_number(std::abs(search.cost - result.main.cost), 2)));
    }
  }
  return listed(parts);
}

std::string integrator_text(const OedometerFit& fit) {
  double largest = 0.0;
  std::vector<std::string> failed;
  for (const calibration::IntegratorCheck& check : fit.assessment->integrators) {
    largest = std::max(largest, check.largest_over_noise);
    if (!check.failure.empty()) failed.push_back(check.test);
  }
  std::string text =
      fmt::format("Fellin-Ostermann and CVODE differ by at most {} of the noise", format_number(largest, 2));
  if (!failed.empty()) text += fmt::format("; CVODE could not follow {}", listed(failed));
  return text;
}

/// "0.50 % of stress (stated 0.50 %)" of each channel.
std::string noise_text(const OedometerFit& fit) {
  std::vector<std::string> parts;
  for (const calibration::ChannelNoise& channel : fit.noise.channels) {
    constexpr double kPercent = 100.0;
    const bool stress = channel.quantity.starts_with("ln");
    const auto level = [&](double value) {
      return stress ? fmt::format("{} %", format_number(kPercent * value, 2)) : format_number(value, 2);
    };
    parts.push_back(fmt::format("{} {} {} (stated {}), correlation {}", channel.test,
                                stress ? "stress" : "strain", level(channel.model.level),
                                level(channel.stated_level), format_number(channel.model.neighbours(), 2)));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::string adequacy_sentence(const OedometerFit& fit) {
  const double worst = worst_of(fit, false);
  if (fit.result.adequate) {
    return fmt::format(
        "The model is adequate for the fitted oedometer tests: none is missed by more than {} times its "
        "noise (root mean square; {} is the limit, 1 as good as the noise allows), and no stage of them.",
        format_number(worst, 3), format_number(calibration::kAdequate, 2));
  }
  std::vector<std::string> missed;
  for (std::size_t i = 0; i < fit.result.tests.size(); ++i) {
    const TestSummary& test = fit.result.tests[i];
    if (test.held_out) continue;
    const std::string stages = i < fit.checks.size() ? missed_stages(fit.checks[i]) : std::string();
    const bool whole = test.rms_over_noise > calibration::kAdequate;
    if (!whole && stages.empty()) continue;
    std::string text = fmt::format("{} ({})", test.name, format_number(test.rms_over_noise, 3));
    text += stages.empty() ? ", as a whole: no single stage stands out" : " in " + stages;
    missed.push_back(std::move(text));
  }
  return fmt::format(
      "The model is not adequate for the fitted oedometer tests: something in these data is not in the "
      "model. "
      "Missed, in times the noise: {}. The parameters are the best of a model that these data contradict.",
      fmt::join(missed, "; "));
}

std::string prediction_sentence(const OedometerFit& fit) {
  std::vector<std::string> met;
  std::vector<std::string> missed;
  for (std::size_t i = 0; i < fit.result.tests.size(); ++i) {
    const TestSummary& test = fit.result.tests[i];
    if (!test.held_out) continue;
    std::string text = fmt::format("{} to within {}", test.name, times_noise(test.rms_over_noise));
    const std::string stages = i < fit.checks.size() ? missed_stages(fit.checks[i]) : std::string();
    if (!stages.empty()) text += ", missed in " + stages;
    (test.rms_over_noise > calibration::kAdequate || !stages.empty() ? missed : met)
        .push_back(std::move(text));
  }
  if (met.empty() && missed.empty()) return {};
  std::string sentence = "Held out and predicted, not fitted:";
  if (!met.empty()) sentence += fmt::format(" {}", listed(met));
  if (!missed.empty()) sentence += fmt::format("{} not met: {}", met.empty() ? "" : ";", listed(missed));
  return sentence + ".";
}

std::string pattern_sentence(const OedometerFit& fit) {
  constexpr double kRare = 1e-3;
  std::vector<std::string> names;
  for (const TestCheck& check : fit.checks) {
    if (!check.held_out && check.whitened.p_value < kRare) names.push_back(check.name);
  }
  if (names.empty()) return {};
  return fmt::format(
      "Residuals of {} keep a pattern that is not explained by noise that fades from reading to reading: "
      "standard errors may be too small.",
      listed(names));
}

void add_oedometer_verdicts(Page& page, const OedometerFit& fit) {
  const calibration::FitResult& result = fit.result;
  page.verdict(result.adequate ? Tone::good : Tone::bad, adequacy_sentence(fit));
  if (std::string sentence = prediction_sentence(fit); !sentence.empty()) {
    const bool met = sentence.find("not met") == std::string::npos;
    page.verdict(met ? Tone::good : Tone::warning, std::move(sentence));
  }
  if (std::string sentence = pattern_sentence(fit); !sentence.empty()) {
    page.verdict(Tone::warning, std::move(sentence));
  }
  if (!result.uncertainty.null_directions.empty()) {
    page.verdict(Tone::bad, fmt::format("{} {}", gauge_sentence(result),
                                        fmt::join(null_direction_sentences(result), " ")));
  }
  add_warnings(page, result.warnings);
}

void add_oedometer_facts(Page& page, const OedometerFit& fit) {
  std::size_t readings = 0;
  std::size_t compared = 0;
  std::size_t mended = 0;
  std::size_t fitted = 0;
  for (const auto& experiment : fit.experiments) {
    readings += experiment->test().record.rows.size();
    compared += experiment->values().size();
    mended += experiment->test().record.notes.size();
    if (!experiment->held_out()) ++fitted;
  }
  page.fact("Data", fmt::format("{} tests, {} of them fitted; {} readings, {} compared with the model; {} "
                                "remarks on rows left out or mended",
                                fit.experiments.size(), fitted, readings, compared, mended));
  page.fact("Gauge", gauge_sentence(fit.result));
  if (!fit.noise.channels.empty()) page.fact("Noise, estimated", noise_text(fit));
  if (fit.assessment && fit.assessment->multi_start.starts > 0) {
    const calibration::MultiStart& starts = fit.assessment->multi_start;
    page.fact(
        "Answers",
        fmt::format("{} different from {} other starts{}", starts.clusters.size(), starts.starts,
                    starts.failed == 0 ? std::string() : fmt::format(", {} of which failed", starts.failed)));
  }
  if (const std::string agreement = agreement_text(fit); !agreement.empty()) {
    page.fact("Searches", agreement);
  }
  if (fit.assessment && !fit.assessment->integrators.empty()) page.fact("Integrators", integrator_text(fit));
}

Table effect_table(const effects::Values<double>& effects) {
  using enum Alignment;
  Table table{.caption = "Effects that the model has.",
              .header = {"Effect", "Parameters", "Enters at", "Equation", "Meaning"},
              .alignment = {left, left, left, left, left}};
  for (const auto& one : effects.chosen()) {
    std::string parameters;
    for (std::size_t i = 0; i < one.effect->parameters.size(); ++i) {
      const auto& parameter = one.effect->parameters[i];
      parameters += fmt::format("{}{} = {}", i == 0 ? "" : ", ", parameter.name,
                                format_number(one.si[i] / parameter.to_si, 4));
    }
    table.rows.push_back({std::string(one.effect->name), std::move(parameters),
                          std::string(effects::name_of(one.effect->seam)), std::string(one.effect->equation),
                          std::string(one.effect->meaning)});
  }
  return table;
}

Table start_estimate_table(const calibration::FitResult& result) {
  using enum Alignment;
  Table table{.caption = "Effects and starts of tests that were fitted.",
              .header = {"Quantity", "Value ± standard error", "95 % interval", "Verdict", "Why"},
              .alignment = {left, right, right, left, left}};
  for (const calibration::LocalEstimate& si : result.local_estimates) {
    const calibration::LocalEstimate estimate = in_key_unit(si);
    table.rows.push_back({estimate.name, format_with_error(estimate.value, estimate.std_error),
                          interval_text(estimate.ci95_lower, estimate.ci95_upper),
                          std::string(calibration::name_of(estimate.verdict)), estimate.words});
  }
  return table;
}

}  // namespace isotach::reports
