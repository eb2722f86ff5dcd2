// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tables of data and starts.
#include "reports/oedometer_data_section.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/run_info.hpp"
#include "reports/time_axis.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;
using experiments::OedometerExperiment;

Table test_table(const datasets::Study& study, const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Oedometer tests.",
              .header = {"Test", "Data", "Driven by", "Use", "Readings", "Compared", "rms / noise"},
              .alignment = {left, left, left, left, right, right, right}};
  for (std::size_t i = 0; i < fit.result.tests.size(); ++i) {
    const calibration::TestSummary& test = fit.result.tests[i];
    const datasets::OedometerRecord& record = fit.experiments[i]->test().record;
    const bool steps = record.control == datasets::Control::stress;
    table.rows.push_back({test.name, data_name(record.file, study.file), steps ? "load steps" : "strain",
                          test.held_out ? "held out" : "fitted", fmt::format("{}", record.rows.size()),
                          fmt::format("{}", test.values), format_number(test.rms_over_noise, 3)});
  }
  return table;
}

Table specimen_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Specimens.",
              .header = {"Test", "H0 (mm)", "Diameter (mm)", "e0", "Where e0 comes from"},
              .alignment = {left, right, right, right, left}};
  for (const auto& experiment : fit.experiments) {
    const datasets::OedometerTest& test = experiment->test();
    table.rows.push_back({test.name, format_number(1e3 * test.height),
                          test.diameter ? format_number(1e3 * *test.diameter) : std::string(kMissing),
                          format_number(test.void_ratio, 5), test.void_ratio_source});
  }
  return table;
}

std::string K0_text(const datasets::OedometerTest& test, double K0) {
  const auto rule = [&]() -> std::string {
    switch (test.K0_rule) {
      case datasets::InitialK0::given:
        return "given";
      case datasets::InitialK0::jaky:
        return "Jaky, 1 − sin φ_c";
      case datasets::InitialK0::steady:
        return "steady compression, by the law";
    }
    return {};
  };
  const std::string value = std::isfinite(K0) ? format_number(K0, 3) + ", " : std::string();
  return value + rule() + (test.free_K0.moves ? "; fitted" : "");
}

std::string ocr_text(const datasets::OedometerTest& test) {
  if (!test.initial_ocr) return "from stress and void ratio";
  return format_number(*test.initial_ocr, 3) + (test.free_ocr.moves ? "; fitted" : ", given");
}

Table start_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{
      .caption = "Where the model starts.",
      .header = {"Test", "Axial stress (kPa)", "Strain (%)", "Void ratio", "K0", "OCR", "Start is"},
      .alignment = {left, right, right, right, left, left, left},
      .notes = {"K0: radial over axial effective stress; OCR: p_B/p_B+ of the start. An overconsolidation "
                "ratio that is given replaces the void ratio in the law, and the measured one only "
                "places the curve."}};
  for (const auto& experiment : fit.experiments) {
    const datasets::OedometerTest& test = experiment->test();
    const experiments::OedometerStart& start = experiment->protocol().start;
    // the steady K0 is the law's and not known here beforehand
    const double K0 = test.K0_rule == datasets::InitialK0::steady ? std::nan("") : test.initial_K0;
    table.rows.push_back({test.name, format_number(1e-3 * start.axial_stress),
                          format_number(100.0 * start.axial_strain, 3), format_number(start.void_ratio, 5),
                          K0_text(test, K0), ocr_text(test),
                          start.row == experiments::kNoRow
                              ? std::string("as the study gives it")
                              : fmt::format("reading in line {}", test.record.rows[start.row].line)});
  }
  return table;
}

Table pore_pressure_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{.caption = "Base pore pressure of loading, u_b over the total axial stress.",
              .header = {"Test", "Effective stress by", "Least", "Greatest", "Readings", "Outside 3 to 15 %"},
              .alignment = {left, left, right, right, right, right},
              .notes = {"ASTM D4186 keeps the rate of loading such that the ratio stays between 3 and 15 %: "
                        "below, the rate could be higher; above, stress and strain are too uneven over the "
                        "height for one mean effective stress. Linear: σ − (2/3) u_b; nonlinear: "
                        "(σ³ − 2 σ² u_b + σ u_b²)^(1/3)."}};
  for (const auto& experiment : fit.experiments) {
    const auto& check = experiment->test().record.pore_pressure;
    if (!check) continue;
    const auto percent = [](double ratio) { return fmt::format("{} %", format_number(100.0 * ratio, 2)); };
    table.rows.push_back({experiment->name(),
                          check->reduced_by ? std::string(datasets::name_of(*check->reduced_by))
                                            : std::string("the laboratory"),
                          percent(check->least_ratio), percent(check->greatest_ratio),
                          fmt::format("{}", check->loading_rows), fmt::format("{}", check->outside)});
  }
  return table;
}

Table consolidation_table(const OedometerFit& fit) {
  using enum Alignment;
  Table table{
      .caption = "End of primary consolidation of each load step.",
      .header = {"Test", "Step", "Load (kPa)", "End after the load", "How"},
      .alignment = {left, right, right, right, left},
      .notes = {"Up to there the law, which is drained, brings the load on at a constant rate, and no "
                "reading is compared; from there on strain is compared."}};
  for (const auto& experiment : fit.experiments) {
    std::string name = experiment->name();
    for (const auto& consolidation : experiment->protocol().consolidation) {
      const datasets::LoadStep& step = experiment->test().record.steps[consolidation.step];
      std::string end = kMissing;
      if (consolidation.end) {
        const TimeUnit unit = time_unit_for(*consolidation.end);
        end = fmt::format("{} {}", format_number(*consolidation.end / unit.seconds, 3), unit.name);
      }
      table.rows.push_back({std::exchange(name, ""), fmt::format("{}", consolidation.step + 1),
                            format_number(1e-3 * step.load), std::move(end), consolidation.how});
    }
  }
  return table;
}

Table note_table(const datasets::Study& study, const OedometerFit& fit) {
  Table table{.caption = "Rows left out or mended.",
              .header = {"Data", "Line", "What"},
              .alignment = {Alignment::left, Alignment::right, Alignment::left}};
  for (const auto& experiment : fit.experiments) {
    const datasets::OedometerRecord& record = experiment->test().record;
    for (const datasets::RowNote& note : record.notes) {
      table.rows.push_back({data_name(record.file, study.file), fmt::format("{}", note.line), note.what});
    }
  }
  return table;
}

std::vector<std::string> assumptions_of(const datasets::Study& study, const OedometerFit& fit) {
  std::vector<std::string> texts;
  for (const auto& experiment : fit.experiments) {
    const datasets::OedometerRecord& record = experiment->test().record;
    const std::string data = data_name(record.file, study.file);
    if (!record.unknown_columns.empty()) {
      texts.push_back(fmt::format("{}: columns not read: {}", data, listed(record.unknown_columns)));
    }
    if (record.stages_deduced) {
      texts.push_back(
          fmt::format("{}: no stage column, loading and unloading deduced from the strains "
                      "(movement below {} taken for noise)",
                      data, format_number(record.stage_threshold, 2)));
    }
  }
  for (const std::string& text : assumptions_on(study.assumptions, "oedometer test")) texts.push_back(text);
  return texts;
}

}  // namespace

void add_oedometer_data(Page& page, const datasets::Study& study, const OedometerFit& fit) {
  page.table(test_table(study, fit));
  page.table(specimen_table(fit));
  page.table(start_table(fit));
  if (Table pore = pore_pressure_table(fit); !pore.rows.empty()) {
    page.table(std::move(pore));
  } else {
    page.paragraph("No test has base pore pressures to be checked.");
  }
  if (Table consolidation = consolidation_table(fit); !consolidation.rows.empty()) {
    page.table(std::move(consolidation));
  }
  if (Table notes = note_table(study, fit); !notes.rows.empty()) {
    page.table(std::move(notes));
  } else {
    page.paragraph("No row had to be mended or left out.");
  }
  const std::vector<std::string> assumptions = assumptions_of(study, fit);
  page.box(Tone::plain, assumptions.empty() ? "Nothing had to be taken for granted: the study gives it all."
                                            : "Taken for granted:\n" + bulleted(assumptions));
}

}  // namespace isotach::reports
