// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/slump_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "model/parameters.hpp"
#include "reports/fit_sections.hpp"
#include "reports/json_number.hpp"
#include "reports/material_table.hpp"
#include "reports/number.hpp"
#include "reports/result_head.hpp"
#include "reports/slump_differences.hpp"
#include "reports/slump_json.hpp"
#include "reports/slump_tables.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

constexpr std::size_t kMostTimes = 6;  // figures of outlines
constexpr std::size_t kColours = 7;    // of the palette
constexpr double kRoom = 1.05;         // of an axis over what it shows
constexpr double kHistoryShape = 0.9;  // height to width

/// What tells the k-th slump from the others in every figure: the palette's colours, then the same, dashed.
void mark(Series& series, std::size_t k) {
  series.colour = palette_colour(k);
  if (k >= kColours) series.style = SeriesStyle::dashed;
}

Figure outlines_figure(const EndedSlumps& slumps, std::optional<double> time) {
  Figure figure = meridian_figure();
  figure.caption =
      fmt::format("Outlines {}.", time ? "at " + time_label(*time) : "at the last output time of each");
  for (const ComparedSlump* slump : slumps) {
    Series outline = outline_series(outline_at(*slump, time), slump->name);
    mark(outline, figure.series.size());
    figure.series.push_back(std::move(outline));
  }
  return figure;
}

/// Outlines at as many of the times as there is room for, two by two, with the same axes: what moved is seen.
std::vector<Figure> outline_figures(const EndedSlumps& slumps, const std::vector<double>& times) {
  std::vector<Figure> figures;
  if (times.empty()) figures.push_back(outlines_figure(slumps, std::nullopt));
  for (const std::size_t k : spread_indices(times.size(), kMostTimes)) {
    figures.push_back(outlines_figure(slumps, times[k]));
  }
  double r = 0.0;
  double z = 0.0;
  for (const Figure& figure : figures) {
    for (const Series& outline : figure.series) {
      r = std::max(r, *std::max_element(outline.x.begin(), outline.x.end()));
      z = std::max(z, *std::max_element(outline.y.begin(), outline.y.end()));
    }
  }
  for (Figure& figure : figures) {
    figure.x.max = kRoom * r;
    figure.y.max = kRoom * z;
  }
  return figures;
}

Figure history_figure(const EndedSlumps& slumps, std::string quantity, double mpm::HistoryRow::*value) {
  Figure figure;
  figure.caption = quantity + " over time.";
  figure.x = {.label = "time (s)", .logarithmic = true};
  figure.y = {.label = std::move(quantity) + " (mm)", .min = 0.0};
  figure.height_to_width = kHistoryShape;
  for (const ComparedSlump* slump : slumps) {
    Series series{.label = slump->name};
    mark(series, figure.series.size());
    for (const mpm::HistoryRow& row : slump->result->history) {
      if (!(row.time > 0.0)) continue;
      series.x.push_back(row.time);
      series.y.push_back(kMillimetres * (row.*value));
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

/// An input as people write it: without the zeros that pad it to its digits.
std::string input_number(double value) {
  std::string text = format_number(value);
  const std::size_t end = std::min(text.find("×"), text.size());
  if (text.find('.') >= end) return text;
  std::size_t kept = end;
  while (text[kept - 1] == '0') --kept;
  if (text[kept - 1] == '.') --kept;
  return text.erase(kept, end - kept);
}

/// A named input of all slumps.
struct Input {
  std::string name;
  std::vector<std::string> values;

  [[nodiscard]] bool differs() const {
    return std::any_of(values.begin(), values.end(), [&](const auto& v) { return v != values.front(); });
  }
};

std::vector<Input> inputs_of(std::span<const ComparedSlump> slumps) {
  std::vector<Input> inputs;
  const auto add = [&](std::string name, auto&& value) {
    Input input{std::move(name), {}};
    for (const ComparedSlump& slump : slumps) input.values.push_back(value(slump));
    inputs.push_back(std::move(input));
  };
  const auto setup = [&add](std::string name, double factor, auto&& value) {
    add(std::move(name), [&](const ComparedSlump& s) { return input_number(factor * value(s.test.setup)); });
  };
  for (const model::ParameterInfo& info : model::kParameterTable) {
    const std::string unit = info.unit == "-" ? "" : fmt::format(" ({})", info.unit);
    add(std::string(info.name) + unit,
        [&info](const ComparedSlump& s) { return input_number(s.test.material[info.id] / info.to_si); });
  }
  setup("mould D (mm)", kMillimetres, [](const mpm::SlumpSetup& s) { return s.mould.diameter; });
  setup("fill h (mm)", kMillimetres, [](const mpm::SlumpSetup& s) { return s.mould.fill_height; });
  setup("lift (m/s)", 1.0, [](const mpm::SlumpSetup& s) { return s.mould.lift_speed; });
  setup("lift delay (s)", 1.0, [](const mpm::SlumpSetup& s) { return s.mould.lift_delay; });
  add("wall", [](const ComparedSlump& s) { return words_of(s.test.setup.mould.wall); });
  add("base", [](const ComparedSlump& s) { return words_of(s.test.setup.base); });
  const auto initial = [&add](std::string name, double factor, double mpm::InitialState::*value) {
    add(std::move(name), [=](const ComparedSlump& s) {
      return s.result ? input_number(factor * (s.result->initial.*value)) : std::string("-");
    });
  };
  initial("e0", 1.0, &mpm::InitialState::void_ratio);
  initial("C_u (kPa)", kPerPascal, &mpm::InitialState::undrained_strength);
  initial("|D| of C_u (1/s)", 1.0, &mpm::InitialState::strength_rate);
  setup("OCR0", 1.0, [](const mpm::SlumpSetup& s) { return s.mud.overconsolidation_ratio; });
  setup("cells (mm)", kMillimetres, [](const mpm::SlumpSetup& s) { return s.numerics.cell_size; });
  setup("K_w (kPa)", kPerPascal, [](const mpm::SlumpSetup& s) { return s.numerics.water_bulk_modulus; });
  setup("background viscosity (Pa s)", 1.0,
        [](const mpm::SlumpSetup& s) { return s.numerics.background_viscosity; });
  return inputs;
}

Table inputs_table(std::span<const ComparedSlump> slumps) {
  Table table{.caption = "What was varied, and what follows from it at the start.",
              .header = {"Slump"},
              .alignment = {Alignment::left}};
  for (const ComparedSlump& slump : slumps) table.rows.push_back({slump.name});
  std::vector<std::string> alike;
  for (const Input& input : inputs_of(slumps)) {
    if (!input.differs()) {
      alike.push_back(fmt::format("{} {}", input.name, input.values.front()));
      continue;
    }
    table.header.push_back(input.name);
    table.alignment.push_back(Alignment::right);
    for (std::size_t k = 0; k < slumps.size(); ++k) table.rows[k].push_back(input.values[k]);
  }
  table.notes = {fmt::format("The same in all: {}.", fmt::join(alike, ", "))};
  return table;
}

Table extent_table(const EndedSlumps& slumps, const std::vector<double>& times) {
  Table table{.caption = "Heights and toes (mm) at the output times that all slumps have.",
              .header = {"Slump"},
              .alignment = {Alignment::left}};
  std::vector<std::optional<double>> columns(times.begin(), times.end());
  const bool all_end_together = std::all_of(slumps.begin(), slumps.end(), [&](const ComparedSlump* slump) {
    return !times.empty() && slump->test.setup.times.back() == times.back();
  });
  if (!all_end_together) columns.emplace_back();
  for (const auto& time : columns) {
    const std::string when = time ? time_label(*time) : "at its end";
    table.header.insert(table.header.end(), {"Height, " + when, "Toe, " + when});
    table.alignment.insert(table.alignment.end(), {Alignment::right, Alignment::right});
  }
  for (const ComparedSlump* slump : slumps) {
    table.rows.push_back({slump->name});
    for (const auto& time : columns) {
      const mpm::Outline& outline = outline_at(*slump, time);
      table.rows.back().push_back(format_number(kMillimetres * outline.height()));
      table.rows.back().push_back(format_number(kMillimetres * outline.toe()));
    }
  }
  return table;
}

/// What was taken for granted, each list once, and the names of the slumps it was taken in.
std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> assumptions_of(
    std::span<const ComparedSlump> slumps) {
  std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> all;
  for (const ComparedSlump& slump : slumps) {
    const std::vector<std::string>& assumptions = slump.test.assumptions;
    if (assumptions.empty()) continue;
    auto alike =
        std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.first == assumptions; });
    if (alike == all.end()) alike = all.insert(all.end(), {assumptions, {}});
    alike->second.push_back(slump.name);
  }
  return all;
}

}  // namespace

Page slump_comparison_report(const RunInfo& run, std::span<const ComparedSlump> slumps) {
  const EndedSlumps done = ended(slumps);
  const std::vector<double> times = shared_times(done);
  Page page("Slump tests, simulated and compared", subtitle(run));
  page.fact("Slumps", fmt::format("{}", slumps.size()));
  for (const ComparedSlump& slump : slumps) {
    if (!slump.result)
      page.verdict(Tone::bad, fmt::format("{}: {}", slump.name, slump.result.error().message));
  }
  add_warnings(page, run.warnings);
  page.table(inputs_table(slumps));
  page.table(extent_table(done, times));

  page.section("Outlines and history");
  std::vector<Figure> outlines = outline_figures(done, times);
  if (outlines.size() == 1) {
    page.figure(std::move(outlines.front()));
  } else {
    page.figures(std::move(outlines));
  }
  page.figures(history_figure(done, "Height", &mpm::HistoryRow::height),
               history_figure(done, "Toe", &mpm::HistoryRow::toe));

  page.section("Start and numerics");
  std::vector<NamedRun> runs;
  for (const ComparedSlump* slump : done) runs.push_back({slump->name, slump->test.setup, &*slump->result});
  page.table(start_table(runs));
  page.table(budget_table(runs));
  page.paragraph(numerics_text(runs.front()));
  for (const auto& [assumptions, names] : assumptions_of(slumps)) {
    page.box(Tone::plain, fmt::format("Taken for granted in {}:\n{}", listed(names), bulleted(assumptions)));
  }
  add_difference_section(page, done);
  return page;
}

nlohmann::ordered_json result_json(const RunInfo& run, std::span<const ComparedSlump> slumps) {
  using nlohmann::ordered_json;
  const EndedSlumps done = ended(slumps);
  const bool failed = done.size() < slumps.size();
  ordered_json json = result_head(run, failed ? "failed" : "ok");
  json["slumps"] = ordered_json::array();
  for (const ComparedSlump& slump : slumps) {
    ordered_json one = {{"name", slump.name},
                        {"file", input_name(slump.test.file)},
                        {"status", slump.result ? "ok" : "failed"}};
    if (slump.result) {
      one.update(slump_json(slump.test.setup, *slump.result));
      one["critical_state_strengths"] = strengths_json(slump);
    } else {
      one["failure"] = slump.result.error().message;
      one["time_s"] = json_number(slump.result.error().time);
    }
    one["assumptions"] = slump.test.assumptions;
    json["slumps"].push_back(std::move(one));
  }
  json["differences"] = differences_json(done);
  return json;
}

}  // namespace isotach::reports
