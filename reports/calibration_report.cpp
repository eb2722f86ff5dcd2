// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The chain of fits, the consistency of its two experiments, and both fits in full.
#include "reports/calibration_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/oedometer_report.hpp"
#include "reports/oedometer_summary.hpp"
#include "reports/slump_fit_report.hpp"
#include "reports/slump_map_section.hpp"

namespace isotach::reports {
namespace {

using calibration::Calibration;
using calibration::ParameterEstimate;
using model::ParameterId;

Table round_table(const Calibration& calibration) {
  constexpr ParameterId kShown[] = {ParameterId::I_v,    ParameterId::C_1,   ParameterId::e100,
                                    ParameterId::lambda, ParameterId::kappa, ParameterId::D_r};
  Table table{.caption = "The chain: parameters after each step.",
              .header = {"Round", "After"},
              .alignment = {Alignment::left, Alignment::left}};
  for (const ParameterId id : kShown) {
    const model::ParameterInfo& info = model::info(id);
    table.header.push_back(info.unit == "-" ? std::string(info.name)
                                            : fmt::format("{} ({})", info.name, info.unit));
    table.alignment.push_back(Alignment::right);
  }
  const auto add = [&](std::string round, std::string after, const model::Parameters<double>& parameters) {
    std::vector<std::string> row{std::move(round), std::move(after)};
    for (const ParameterId id : kShown) row.push_back(format_number(in_key_unit(id, parameters[id])));
    table.rows.push_back(std::move(row));
  };
  for (std::size_t k = 0; k < calibration.rounds.size(); ++k) {
    add(fmt::format("{}", k + 1), "oedometer fit", calibration.rounds[k].after_oedometer);
    add("", calibration.I_v_is_joint ? "joint fit" : "slump fit", calibration.rounds[k].after_slump);
  }
  add("last", "oedometer fit", *calibration.oedometer.result.parameters);
  table.notes = {
      calibration.I_v_is_joint
          ? "Both kinds of test hold I_v, so it is that of the joint fit, at which the oedometer is fitted "
            "last."
          : "The oedometer fit takes I_v from the slump fit before it, where that moves I_v; in the first "
            "round it is that of the study, or its own."};
  std::vector<std::string> meanings;
  for (const ParameterId id : kShown) {
    meanings.push_back(fmt::format("{}: {}", model::info(id).name, model::info(id).meaning));
  }
  table.notes.push_back(fmt::format("{}.", fmt::join(meanings, "; ")));
  return table;
}

std::string value_and_interval(const ParameterEstimate& si) {
  const ParameterEstimate estimate = in_key_unit(si);
  return fmt::format("{} (95 % interval {})", format_with_error(estimate.value, estimate.std_error),
                     interval_text(si));
}

/// What it means that the two kinds of test ask for different parameters.
std::string apart(const Calibration& calibration) {
  if (calibration.oedometer.result.adequate && calibration.slump.result.adequate) {
    return "though one set of parameters meets all fitted tests to within 1.3 times their noise: errors that "
           "all "
           "outlines share, of simulations or of reading, are larger than was allowed for, or the model is "
           "not quite right for both";
  }
  return "so no one set of parameters serves both: one of the two lacks something, in the model, in the "
         "boundaries, or in how it was measured";
}

/// I_v by both kinds of test, where both determine it: two experiments that a right model makes agree.
void add_consistency(Page& page, const Calibration& calibration) {
  const calibration::FitResult& oedometer = calibration.first_oedometer.result;
  const calibration::FitResult& slump = calibration.slump_alone.result;
  if (!is_free(slump, ParameterId::I_v)) return;
  if (!is_free(oedometer, ParameterId::I_v)) {
    page.paragraph(
        "The study does not let the oedometer fit move I_v, so whether both kinds of test ask for the same "
        "I_v was not tested. Add \"I_v\" to [fit] oedometer to test it.");
    return;
  }
  const ParameterEstimate& a = estimate_of(oedometer, ParameterId::I_v);
  const ParameterEstimate& b = estimate_of(slump, ParameterId::I_v);
  // the fits move ln I_v, and in it their errors are symmetric
  const double difference =
      std::abs(std::log(a.value / b.value)) / std::hypot(a.std_error / a.value, b.std_error / b.value);
  constexpr double kQuantile95 = 1.96;
  const bool agree = difference <= kQuantile95;
  page.verdict(
      agree ? Tone::good : Tone::warning,
      fmt::format("I_v from the oedometer alone is {}, from the slump {}: {} combined standard errors of ln "
                  "I_v apart, {}.",
                  value_and_interval(a), value_and_interval(b), format_number(difference, 2),
                  agree ? "so the two kinds of test agree" : apart(calibration)));
  page.paragraph(fmt::format(
      "I_v is where the two kinds of test can contradict each other: the oedometer is loaded at some {} "
      "1/s, a slump flows many orders of magnitude faster, and the same I_v has to serve both.",
      format_number(calibration.oedometer.reference_rate, 2)));
}

/// One objective for both kinds of test, and what that costs each.
void add_joint_fit(Page& page, const Calibration& calibration) {
  if (!calibration.joint) {
    if (!calibration.joint_failure.empty()) {
      page.box(Tone::warning, "There is no joint fit: " + calibration.joint_failure);
    }
    return;
  }
  using enum Alignment;
  const calibration::JointFit& joint = *calibration.joint;
  page.heading("Both kinds of test at once");
  page.paragraph(
      fmt::format("One objective of all fitted tests, the oedometer's by its integrator, the slumps' by a "
                  "surrogate over all that "
                  "moves: {} points simulated{}, points left out missed by {} times the noise.",
                  joint.points, joint.failed > 0 ? fmt::format(", {} in vain", joint.failed) : std::string(),
                  format_number(joint.surrogate->error(), 2)));
  Table table{.caption = "Parameters by each kind of test and by both.",
              .header = {"Parameter", "Oedometer alone", "Slump alone", "Both"},
              .alignment = {left, right, right, right}};
  const auto text = [](const calibration::FitResult& result, ParameterId id) {
    if (!is_free(result, id)) return std::string(kMissing);
    const ParameterEstimate estimate = in_key_unit(estimate_of(result, id));
    return format_with_error(estimate.value, estimate.std_error);
  };
  for (const ParameterId id : joint.result.free) {
    table.rows.push_back({std::string(model::info(id).name), text(calibration.first_oedometer.result, id),
                          text(calibration.slump_alone.result, id), text(joint.result, id)});
  }
  table.notes = {
      fmt::format("Half the sum of squares: oedometer {} alone and {} with the slumps; slumps {} alone and "
                  "{} with the oedometer.",
                  format_number(joint.oedometer_least, 4), format_number(joint.oedometer_cost, 4),
                  format_number(joint.slump_least, 4), format_number(joint.slump_cost, 4))};
  page.table(std::move(table));
  constexpr double kContradiction = 0.01;
  const bool agree = joint.p_value >= kContradiction;
  page.box(
      agree ? Tone::good : Tone::warning,
      fmt::format(
          "Meeting both kinds of test at once raises the misfit by {} where chance allows some {} (p = {}): "
          "{}",
          format_number(joint.rise, 3), joint.shared, format_number(joint.p_value, 2),
          agree ? "one set of parameters serves both." : apart(calibration) + "."));
  add_warnings(page, joint.result.warnings);
}

std::string how_settled(const Calibration& calibration) {
  if (calibration.I_v_is_joint) {
    return calibration.settled ? "I_v is that of both kinds of test at once: refitting the oedometer there "
                                 "moves nothing that "
                                 "matters."
                               : "I_v is that of both kinds of test at once, but refitting the oedometer "
                                 "there moves its other "
                                 "parameters: treat the answer with care.";
  }
  const std::string rounds =
      fmt::format("{} round{}", calibration.rounds.size(), calibration.rounds.size() == 1 ? "" : "s");
  return calibration.settled
             ? fmt::format(
                   "The chain stands still after {}: refitting the oedometer at the slump's answer "
                   "moves nothing that matters.",
                   rounds)
             : fmt::format(
                   "After {} the oedometer and the slump fit still move each other: treat the answer "
                   "with care.",
                   rounds);
}

}  // namespace

Page calibration_report(const RunInfo& run, const datasets::Study& study, const Calibration& calibration) {
  Page page("Calibration", subtitle(run));
  page.verdict(calibration.settled ? Tone::good : Tone::warning, how_settled(calibration));
  const std::vector<ParameterEstimate> estimates = combined_estimates(calibration);
  add_oedometer_verdicts(page, calibration.oedometer);
  add_slump_fit_verdicts(page, calibration.slump);
  add_parameter_verdicts(page, estimates);
  add_warnings(page, run.warnings);
  add_data_note(page, study);
  add_slump_fit_facts(page, calibration.slump);
  page.table(parameter_table(estimates, "Parameters, each from the fit that moved it.", Meanings::left_out));
  if (Table effects = effect_table(calibration.oedometer.effects); !effects.rows.empty()) {
    page.table(std::move(effects));
  }
  if (Table moved = start_estimate_table(calibration.slump.result); !moved.rows.empty()) {
    moved.caption = "Effects and mud of the slump tests that were fitted.";
    page.table(std::move(moved));
  }
  if (Table moved = start_estimate_table(calibration.oedometer.result); !moved.rows.empty()) {
    page.table(std::move(moved));
  }

  page.section("The chain of fits");
  page.table(round_table(calibration));
  add_consistency(page, calibration);
  page.table(parameter_table(calibration.slump_alone.result.estimates,
                             "What the slump tests alone say, from the first slump fit.",
                             Meanings::left_out));
  add_slump_map(page, calibration.slump_alone);
  add_joint_fit(page, calibration);
  page.paragraph(
      "A parameter that the oedometer moves too, other than I_v, is the oedometer's in the later rounds: in "
      "undrained "
      "flow at the critical state C_1 only scales the rate, by (1 − C_1), and what outlines say of it rests "
      "on the "
      "way there.");
  page.paragraph("Verdicts on parameters. " + std::string(kVerdictNote));
  page.paragraph(
      "Below follow the last fits of the chain; the searches they show are those of the last round.");
  add_oedometer_sections(page, study, calibration.oedometer, "Oedometer: ");
  add_slump_fit_section(page, study, calibration.slump);
  return page;
}

}  // namespace isotach::reports
