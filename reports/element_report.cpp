// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The page of an element test.
#include "reports/element_report.hpp"

#include <fmt/format.h>

#include <utility>

#include "reports/element_figures.hpp"
#include "reports/fit_sections.hpp"
#include "reports/material_table.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

constexpr std::size_t kStagesListed = 40;

/// Index of the last row of each stage that has begun, and no more.
std::vector<std::size_t> last_rows(const ElementCurve& curve) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (i + 1 == curve.size() || curve.stage[i + 1] != curve.stage[i]) rows.push_back(i);
  }
  return rows;
}

std::vector<std::string> stage_cells(const ElementCurve& curve, std::size_t row) {
  return {format_number(curve.time[row]), format_number(curve.p[row]), format_number(shown_q(curve, row)),
          format_number(curve.void_ratio[row], 5), format_number(curve.ocr[row])};
}

Table stage_table(const datasets::ElementFile& test, const ElementCurve& curve) {
  using enum Alignment;
  Table table{.caption = "Stages, and what each ended with.",
              .header = {"Stage", "Control", "Time (s)", "p (kPa)", "q (kPa)", "e", "OCR"},
              .alignment = {left, left, right, right, right, right, right}};
  const auto add = [&](std::string name, std::string control, std::size_t row) {
    std::vector<std::string> cells{std::move(name), std::move(control)};
    for (std::string& cell : stage_cells(curve, row)) cells.push_back(std::move(cell));
    table.rows.push_back(std::move(cells));
  };
  add("start", "", 0);
  const std::vector<std::size_t> ends = last_rows(curve);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    // of very many, the first and the last
    if (ends.size() > kStagesListed && k >= kStagesListed / 2 && k + kStagesListed / 2 < ends.size())
      continue;
    const integrators::Stage& stage = test.stages[curve.stage[ends[k]]];
    add(stage.name, control_text(stage), ends[k]);
  }
  table.notes = {"Compression positive; strains are logarithmic, shear strains tensor components."};
  if (!curve.axis)
    table.notes.emplace_back("q is √(3/2) |T*|, without sign: stress has no axis of symmetry.");
  if (ends.size() > kStagesListed) {
    table.notes.push_back(
        fmt::format("{} stages in all; the first and the last {} are listed, result.json has every "
                    "one.",
                    ends.size(), kStagesListed / 2));
  }
  return table;
}

/// The first values of a tensor's components, as a row of a table.
std::vector<std::string> tensor_cells(std::string name, const std::array<ElementCurve::Column, 6>& tensor) {
  std::vector<std::string> cells{std::move(name)};
  for (const ElementCurve::Column& component : tensor) cells.push_back(format_number(component.front()));
  return cells;
}

Table start_table(const ElementCurve& curve) {
  using enum Alignment;
  Table table{.caption = "Start.",
              .header = {"", "11", "22", "33", "12", "13", "23"},
              .alignment = {left, right, right, right, right, right, right}};
  table.rows.push_back(tensor_cells("stress (kPa)", curve.stress));
  table.rows.push_back(tensor_cells("Ω", curve.omega));
  table.notes = {fmt::format("e = {}, p_B = {} kPa, OCR = {}.", format_number(curve.void_ratio.front(), 5),
                             format_number(curve.p_B.front()), format_number(curve.ocr.front()))};
  return table;
}

void add_figures(Page& page, std::vector<ElementFigures> groups) {
  for (ElementFigures& group : groups) {
    page.section(group.heading);
    std::vector<ElementFigure>& all = group.figures;
    for (std::size_t i = 0; i < all.size(); i += 2) {
      if (i + 1 < all.size()) {
        page.figures(std::move(all[i].figure), std::move(all[i + 1].figure));
      } else {
        all[i].figure.height_to_width = 0.5;
        page.figure(std::move(all[i].figure));
      }
    }
  }
}

}  // namespace

std::string failure_text(const datasets::ElementFile& test, const ElementRun& result) {
  const integrators::ElementFailure& failure = *result.failure;
  const std::string where =
      fmt::format("stage \"{}\", {:.6g} s after the start", test.stages[failure.stage].name, failure.time);
  return failure.interrupted ? fmt::format("{}: interrupted", where)
                             : fmt::format("{}: {}", where, failure.failure.message());
}

std::string summary_text(const datasets::ElementFile& test, const ElementRun& result) {
  const ElementCurve curve(test, result.rows);
  return fmt::format("ends at {:.6g} s with p = {:.6g} kPa, q = {:.6g} kPa, e = {:.6g}, OCR = {:.6g}",
                     curve.time.back(), curve.p.back(), shown_q(curve, curve.size() - 1),
                     curve.void_ratio.back(), curve.ocr.back());
}

Page element_report(const RunInfo& run, const datasets::ElementFile& test, const ElementRun& result) {
  Page page("Element test", subtitle(run));
  const ElementCurve curve(test, result.rows);
  if (result.failure) {
    page.verdict(Tone::bad, fmt::format("The test did not reach its end. {}.", failure_text(test, result)));
  } else {
    page.verdict(Tone::plain, fmt::format("The test {}.", summary_text(test, result)));
  }
  add_warnings(page, run.warnings);
  if (test.note) page.fact("Note", *test.note);
  const integrators::Statistics& cost = result.rows.back().statistics;
  page.fact("Integrator",
            fmt::format("{}, relative tolerance {}: {} steps, {} rejected, {} evaluations of the rate",
                        integrators::name(result.method), format_number(result.tolerance, 2), cost.accepted,
                        cost.rejected, cost.evaluations));
  page.fact("Rows", fmt::format("{} in {} stage{}", result.rows.size(), test.stages.size(),
                                test.stages.size() == 1 ? "" : "s"));
  page.table(stage_table(test, curve));
  if (curve.size() > 1) add_figures(page, element_figures(test, curve));
  page.section("Material and start");
  page.table(material_table(test.material));
  page.table(start_table(curve));
  return page;
}

}  // namespace isotach::reports
