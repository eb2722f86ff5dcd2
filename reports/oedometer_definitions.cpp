// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Symbols, units and verdicts in words.
#include <fmt/format.h>

#include "model/parameters.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/oedometer_data_section.hpp"

namespace isotach::reports {
namespace {

Table symbol_table() {
  Table table{.caption = "Symbols.", .header = {"Symbol", "Unit", "Meaning"}};
  for (const model::ParameterInfo& info : model::kParameterTable) {
    table.rows.push_back(
        {std::string(info.name), info.unit == "-" ? "–" : std::string(info.unit), std::string(info.meaning)});
  }
  const char* const further[][3] = {
      {"e, e0", "–", "void ratio: volume of voids over volume of solids; of the specimen before the test"},
      {"axial strain", "%", "(H0 − H)/H0, H the height; compression positive"},
      {"axial stress", "kPa", "effective, compression positive"},
      {"K0", "–", "radial over axial effective stress"},
      {"p, q", "kPa", "mean effective stress; deviatoric stress, σ_axial − σ_radial"},
      {"p_B+", "kPa",
       "p + q²/(M² p): mean stress of the ellipse through the present stress, M = q/p at the "
       "critical state"},
      {"p_B", "kPa", "100 kPa ((1+e)/(1+e100))^(−1/λ): the preconsolidation pressure of the void ratio"},
      {"OCR", "–", "p_B/p_B+: 1 on the isotach of D_r, larger below it"},
      {"isotach", "1/s", "line of equal strain rate in the plane of void ratio and stress"},
      {"noise", "–", "standard deviation of a reading's error"},
  };
  for (const auto& row : further) table.rows.push_back({row[0], row[1], row[2]});
  return table;
}

}  // namespace

void add_oedometer_definitions(Page& page) {
  page.table(symbol_table());
  page.paragraph("Verdicts on parameters. " + std::string(kVerdictNote) +
                 " Gauge: set by convention, see the section on uncertainty.");
  page.paragraph(fmt::format(
      "Verdict on the model. Adequate: the root mean square of the residuals of every fitted test is at most "
      "{} times the noise that the study states, and no stage of it is missed. A stage is missed where its "
      "root mean square is above {} times the noise and noise alone would be as large less than once in a "
      "thousand times.",
      format_number(calibration::kAdequate, 2), format_number(calibration::kStageMisfit, 2)));
  page.paragraph(
      "Standard error: the standard deviation of an estimate over repetitions of the tests with other noise. "
      "95 % interval: made so that it holds the true value in 95 of 100 such repetitions, if the model is "
      "right.");
}

}  // namespace isotach::reports
