// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/slump_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "model/parameters.hpp"
#include "reports/fit_sections.hpp"
#include "reports/json_number.hpp"
#include "reports/material_table.hpp"
#include "reports/number.hpp"
#include "reports/result_head.hpp"
#include "reports/slump_json.hpp"
#include "reports/slump_tables.hpp"

namespace isotach::reports {
namespace {

constexpr double kMillimetres = 1e3;   // in a metre
constexpr std::size_t kMostTimes = 6;  // figures of outlines
constexpr double kHistoryShape = 0.9;  // height to width

using Slumps = std::vector<const ComparedSlump*>;

Slumps ended(std::span<const ComparedSlump> slumps) {
  Slumps result;
  for (const ComparedSlump& slump : slumps) {
    if (slump.result) result.push_back(&slump);
  }
  return result;
}

/// Output times that all slumps have (s).
std::vector<double> shared_times(const Slumps& slumps) {
  std::vector<double> times = slumps.front()->test.setup.times;
  for (const ComparedSlump* slump : slumps) {
    const std::vector<double>& own = slump->test.setup.times;
    std::erase_if(times, [&](double t) { return std::find(own.begin(), own.end(), t) == own.end(); });
  }
  return times;
}

const mpm::Outline& outline_at(const ComparedSlump& slump, std::optional<double> time) {
  const std::vector<double>& times = slump.test.setup.times;
  const auto found = time ? std::find(times.begin(), times.end(), *time) : times.end() - 1;
  return slump.result->outlines[static_cast<std::size_t>(found - times.begin())];
}

Figure outlines_figure(const Slumps& slumps, std::optional<double> time) {
  Figure figure = meridian_figure();
  figure.caption =
      fmt::format("Outlines {}.", time ? "at " + time_label(*time) : "at the last output time of each");
  std::size_t colour = 0;
  for (const ComparedSlump* slump : slumps) {
    Series outline = outline_series(outline_at(*slump, time), slump->name);
    outline.colour = palette_colour(colour++);
    figure.series.push_back(std::move(outline));
  }
  return figure;
}

Figure history_figure(const Slumps& slumps, std::string quantity, double mpm::HistoryRow::*value) {
  Figure figure;
  figure.caption = quantity + " over time.";
  figure.x = {.label = "time (s)", .logarithmic = true};
  figure.y = {.label = std::move(quantity) + " (mm)", .min = 0.0};
  figure.height_to_width = kHistoryShape;
  for (const ComparedSlump* slump : slumps) {
    Series series{.label = slump->name};
    for (const mpm::HistoryRow& row : slump->result->history) {
      if (!(row.time > 0.0)) continue;
      series.x.push_back(row.time);
      series.y.push_back(kMillimetres * (row.*value));
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
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
    add(std::move(name), [&](const ComparedSlump& s) { return format_number(factor * value(s.test.setup)); });
  };
  for (const model::ParameterInfo& info : model::kParameterTable) {
    const std::string unit = info.unit == "-" ? "" : fmt::format(" ({})", info.unit);
    add(std::string(info.name) + unit,
        [&info](const ComparedSlump& s) { return format_number(s.test.material[info.id] / info.to_si); });
  }
  setup("mould D (mm)", kMillimetres, [](const mpm::SlumpSetup& s) { return s.mould.diameter; });
  setup("fill h (mm)", kMillimetres, [](const mpm::SlumpSetup& s) { return s.mould.fill_height; });
  setup("lift (m/s)", 1.0, [](const mpm::SlumpSetup& s) { return s.mould.lift_speed; });
  setup("lift delay (s)", 1.0, [](const mpm::SlumpSetup& s) { return s.mould.lift_delay; });
  add("wall", [](const ComparedSlump& s) { return words_of(s.test.setup.mould.wall); });
  add("base", [](const ComparedSlump& s) { return words_of(s.test.setup.base); });
  const auto initial = [&add](std::string name, double factor, double mpm::InitialState::*value) {
    add(std::move(name), [=](const ComparedSlump& s) {
      return s.result ? format_number(factor * (s.result->initial.*value)) : std::string("-");
    });
  };
  initial("e0", 1.0, &mpm::InitialState::void_ratio);
  initial("C_u (kPa)", 1e-3, &mpm::InitialState::undrained_strength);
  setup("OCR0", 1.0, [](const mpm::SlumpSetup& s) { return s.mud.overconsolidation_ratio; });
  setup("cells (mm)", kMillimetres, [](const mpm::SlumpSetup& s) { return s.numerics.cell_size; });
  setup("K_w (kPa)", 1e-3, [](const mpm::SlumpSetup& s) { return s.numerics.water_bulk_modulus; });
  setup("background viscosity (Pa s)", 1.0,
        [](const mpm::SlumpSetup& s) { return s.numerics.background_viscosity; });
  return inputs;
}

Table inputs_table(std::span<const ComparedSlump> slumps) {
  Table table{
      .caption = "What differs between the slumps.", .header = {"Slump"}, .alignment = {Alignment::left}};
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

Table extent_table(const Slumps& slumps, const std::vector<double>& times) {
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

}  // namespace

Page slump_comparison_report(const RunInfo& run, std::span<const ComparedSlump> slumps) {
  const Slumps done = ended(slumps);
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
  if (times.empty()) page.figure(outlines_figure(done, std::nullopt));
  for (const std::size_t k : spread_indices(times.size(), kMostTimes)) {
    page.figure(outlines_figure(done, times[k]));
  }
  page.figures(history_figure(done, "height", &mpm::HistoryRow::height),
               history_figure(done, "toe", &mpm::HistoryRow::toe));

  page.section("Start and numerics");
  std::vector<NamedRun> runs;
  for (const ComparedSlump* slump : done) runs.push_back({slump->name, &slump->test.setup, &*slump->result});
  page.table(start_table(runs));
  page.table(budget_table(runs));
  page.paragraph(numerics_text(runs.front()));
  for (const ComparedSlump& slump : slumps) {
    if (slump.test.assumptions.empty()) continue;
    page.box(Tone::plain,
             fmt::format("Taken for granted in {}:\n{}", slump.name, bulleted(slump.test.assumptions)));
  }
  return page;
}

nlohmann::ordered_json result_json(const RunInfo& run, std::span<const ComparedSlump> slumps) {
  using nlohmann::ordered_json;
  const bool failed = std::any_of(slumps.begin(), slumps.end(), [](const auto& s) { return !s.result; });
  ordered_json json = result_head(run, failed ? "failed" : "ok");
  json["slumps"] = ordered_json::array();
  for (const ComparedSlump& slump : slumps) {
    ordered_json one = {{"name", slump.name},
                        {"file", input_name(slump.test.file)},
                        {"status", slump.result ? "ok" : "failed"}};
    if (slump.result) {
      one.update(slump_json(slump.test.setup, *slump.result));
    } else {
      one["failure"] = slump.result.error().message;
      one["time_s"] = json_number(slump.result.error().time);
    }
    one["assumptions"] = slump.test.assumptions;
    json["slumps"].push_back(std::move(one));
  }
  return json;
}

}  // namespace isotach::reports
