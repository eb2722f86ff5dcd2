// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tables of refits.
#include "reports/robustness_section.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/estimates.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/time_axis.hpp"

namespace isotach::reports {
namespace {

using calibration::FitResult;
using calibration::OedometerFit;
using calibration::Refit;

/// "+0.0012", with a sign in any case.
std::string signed_number(double value, int digits) {
  const std::string text = format_number(value, digits);
  return value > 0.0 ? "+" + text : text;
}

/// The parameters that a fit moved, and D_r where it follows from them.
std::vector<model::ParameterId> moved_parameters(const FitResult& result) {
  std::vector<model::ParameterId> moved = result.free;
  if (result.gauged) moved.push_back(model::ParameterId::D_r);
  return moved;
}

std::string parameter_name(model::ParameterId id) {
  const model::ParameterInfo& info = model::info(id);
  return info.unit == "-" ? std::string(info.name) : fmt::format("{} ({})", info.name, info.unit);
}

/// What became of a parameter: its shift, and that in standard errors where it is a coordinate.
std::string shift_text(const FitResult& result, const Refit& refit, model::ParameterId id, std::size_t k) {
  if (!refit.parameters) return kMissing;
  const double shift = in_key_unit(id, (*refit.parameters)[id]) - in_key_unit(id, (*result.parameters)[id]);
  std::string text = signed_number(shift, 2);
  if (k < refit.shift.size() && std::isfinite(refit.shift[k])) {
    text += fmt::format(" ({})", signed_number(refit.shift[k], 2));
  }
  return text;
}

}  // namespace

Table left_out_table(const OedometerFit& fit) {
  Table table{
      .caption = "The fit without each test in turn.", .header = {"Fit"}, .alignment = {Alignment::left}};
  const auto moved = moved_parameters(fit.result);
  for (const model::ParameterId id : moved) table.header.push_back(parameter_name(id));
  table.header.push_back("Left-out test: rms / noise");
  table.alignment.resize(table.header.size(), Alignment::right);
  const auto add = [&](std::string what, const std::optional<model::Parameters<double>>& parameters,
                       std::string rms) {
    std::vector<std::string> row{std::move(what)};
    for (const model::ParameterId id : moved) {
      row.push_back(parameters ? format_number(in_key_unit(id, (*parameters)[id]), 4)
                               : std::string(kMissing));
    }
    row.push_back(std::move(rms));
    table.rows.push_back(std::move(row));
  };
  add("all fitted tests", fit.result.parameters, kMissing);
  for (const Refit& refit : fit.assessment->without_test) {
    const bool predicted = refit.parameters && refit.failure.empty();
    add(refit.what, refit.parameters,
        predicted ? format_number(refit.rms_over_noise, 3) : std::string(kMissing));
    if (!refit.failure.empty()) table.notes.push_back(fmt::format("{}: {}", refit.what, refit.failure));
  }
  table.notes.insert(table.notes.begin(),
                     "Parameters that move by much more than their standard errors say that the tests do not "
                     "agree on them; the last column is how well the others predict the test left out.");
  return table;
}

Table input_table(const OedometerFit& fit) {
  const FitResult& result = fit.result;
  Table table{.caption =
                  "Influence of assumed inputs: shift of each quantity, in its unit and, in brackets, in "
                  "standard errors.",
              .header = {""},
              .alignment = {Alignment::left}};
  for (const Refit& refit : fit.assessment->shifted_inputs) {
    table.header.push_back(refit.what);
    table.alignment.push_back(Alignment::right);
  }
  const auto moved = moved_parameters(result);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    std::vector<std::string> row{parameter_name(moved[k])};
    const std::size_t coordinate = k < result.free.size() ? k : result.coordinates.size();
    for (const Refit& refit : fit.assessment->shifted_inputs) {
      row.push_back(shift_text(result, refit, moved[k], coordinate));
    }
    table.rows.push_back(std::move(row));
  }
  for (std::size_t k = result.free.size(); k < result.coordinates.size(); ++k) {
    std::vector<std::string> row{result.coordinates[k].name};
    for (const Refit& refit : fit.assessment->shifted_inputs) {
      const bool known = k < refit.shift.size() && std::isfinite(refit.shift[k]);
      row.push_back(known ? fmt::format("({})", signed_number(refit.shift[k], 2)) : std::string(kMissing));
    }
    table.rows.push_back(std::move(row));
  }
  std::vector<std::string> rms{"rms / noise of all fitted tests"};
  for (const Refit& refit : fit.assessment->shifted_inputs) {
    rms.push_back(refit.parameters ? format_number(refit.rms_over_noise, 3) : std::string(kMissing));
    if (!refit.failure.empty()) table.notes.push_back(fmt::format("{}: {}", refit.what, refit.failure));
  }
  table.rows.push_back(std::move(rms));
  return table;
}

Table integrator_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Predictions at the answer with Fellin-Ostermann and with CVODE.",
              .header = {"Test", "Largest difference / noise", "At time"},
              .alignment = {left, right, right}};
  for (const calibration::IntegratorCheck& check : fit.assessment->integrators) {
    if (!check.failure.empty()) {
      table.rows.push_back({check.test, kMissing, kMissing});
      table.notes.push_back(fmt::format("{}: {}", check.test, check.failure));
      continue;
    }
    const TimeUnit unit = time_unit_for(check.at_time);
    table.rows.push_back({check.test, format_number(check.largest_over_noise, 2),
                          fmt::format("{} {}", format_number(check.at_time / unit.seconds, 3), unit.name)});
  }
  table.notes.push_back(
      "Two ways of integrating the law that share nothing but its equations: an explicit scheme with error "
      "control, which the fit uses, and an implicit one of variable order at a tolerance of 1e-10. Well "
      "below "
      "1, the numerics play no part in the answer.");
  return table;
}

void add_robustness(Page& page, const OedometerFit& fit) {
  if (!fit.assessment) return;
  if (!fit.assessment->without_test.empty()) {
    page.table(left_out_table(fit));
  } else {
    page.paragraph("Only one test is fitted, so none could be left out in turn.");
  }
  if (!fit.assessment->shifted_inputs.empty()) {
    page.paragraph(
        "What was put in and not fitted shifts the answer without showing in the standard errors. Each such "
        "input was moved by what it may well be wrong by, and everything fitted again.");
    page.table(input_table(fit));
  }
  if (!fit.assessment->integrators.empty()) page.table(integrator_table(fit));
}

}  // namespace isotach::reports
