// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/element_holds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "reports/slump_tables.hpp"

namespace isotach::reports {
namespace {

using Column = ElementCurve::Column;

constexpr std::size_t kHoldsShown = 7;  // as many as the palette has colours
constexpr double kPercent = 100.0;

/// A stage that holds, by the rows from where it began.
struct Hold {
  std::string name;
  bool creep;   // else relaxation
  Column time;  // s since it began; the first is 0
  std::size_t first_row;
};

std::vector<Hold> holds_of(const datasets::ElementFile& test, const ElementCurve& curve) {
  std::vector<Hold> holds;
  double begin = 0.0;
  std::size_t row = 0;  // the one that the stage begins from
  for (std::size_t s = 0; s < test.stages.size(); ++s) {
    const integrators::Stage& stage = test.stages[s];
    std::size_t end = row;
    while (end + 1 < curve.size() && curve.stage[end + 1] == s) ++end;
    if (is_hold(stage) && end > row) {
      bool creep = false;
      for (const bool controlled : stage.increment.stress_controlled) creep = creep || controlled;
      Hold hold{stage.name, creep, {}, row};
      for (std::size_t i = row; i <= end; ++i) hold.time.push_back(curve.time[i] - begin);
      holds.push_back(std::move(hold));
    }
    row = end;
    begin += stage.increment.duration;
  }
  return holds;
}

Figure log_time_figure(std::string caption, std::string label) {
  Figure figure;
  figure.caption = std::move(caption);
  figure.x = {.label = "time since the hold began (s)", .logarithmic = true};
  figure.y = {.label = std::move(label)};
  figure.height_to_width = 0.85;
  return figure;
}

void add_creep(std::vector<ElementFigure>& figures, const std::vector<const Hold*>& holds,
               const ElementCurve& curve) {
  const std::string_view name = kComponentNames[curve.driven];
  ElementFigure strain{
      "creep_strain", "time_since_s", fmt::format("strain_{}_percent", name),
      log_time_figure("Creep: strain since the hold began.", fmt::format("strain ε{} (%)", name))};
  strain.figure.y.reversed = true;
  ElementFigure rate{"creep_rate", "time_since_s", "strain_rate_per_s",
                     log_time_figure("Creep: strain rate, the mean between rows.",
                                     fmt::format("|rate of ε{}| (1/s)", name))};
  rate.figure.y.logarithmic = true;
  for (const Hold* hold : holds) {
    Series strains{.label = hold->name};
    Series rates{.label = hold->name};
    const Column& all = curve.strain[curve.driven];
    for (std::size_t i = 1; i < hold->time.size(); ++i) {
      const std::size_t row = hold->first_row + i;
      strains.x.push_back(hold->time[i]);
      strains.y.push_back(kPercent * (all[row] - all[hold->first_row]));
      const double since = std::max(hold->time[i - 1], 0.5 * hold->time[1]);
      rates.x.push_back(std::sqrt(since * hold->time[i]));
      rates.y.push_back(std::abs(all[row] - all[row - 1]) / (hold->time[i] - hold->time[i - 1]));
    }
    strain.figure.series.push_back(std::move(strains));
    rate.figure.series.push_back(std::move(rates));
  }
  figures.push_back(std::move(strain));
  figures.push_back(std::move(rate));
}

void add_relaxation(std::vector<ElementFigure>& figures, const std::vector<const Hold*>& holds,
                    const ElementCurve& curve) {
  const auto add = [&](const char* file, const char* key, const char* caption, const char* label,
                       const Column& values) {
    ElementFigure drawn{file, "time_since_s", key, log_time_figure(caption, label)};
    for (const Hold* hold : holds) {
      Series series{.label = hold->name};
      for (std::size_t i = 1; i < hold->time.size(); ++i) {
        series.x.push_back(hold->time[i]);
        series.y.push_back(values[hold->first_row + i]);
      }
      drawn.figure.series.push_back(std::move(series));
    }
    figures.push_back(std::move(drawn));
  };
  add("relaxation_p", "p_kPa", "Relaxation: mean stress.", "p (kPa)", curve.p);
  if (changes(curve.q, 1e-6))
    add("relaxation_q", "q_kPa", "Relaxation: deviatoric stress.", "q (kPa)", curve.q);
}

}  // namespace

std::vector<ElementFigure> hold_figures(const datasets::ElementFile& test, const ElementCurve& curve) {
  const std::vector<Hold> holds = holds_of(test, curve);
  std::vector<ElementFigure> figures;
  for (const bool creep : {true, false}) {
    std::vector<const Hold*> all;
    for (const Hold& hold : holds) {
      if (hold.creep == creep) all.push_back(&hold);
    }
    if (all.empty()) continue;
    std::vector<const Hold*> shown;
    for (const std::size_t i : spread_indices(all.size(), kHoldsShown)) shown.push_back(all[i]);
    (creep ? add_creep : add_relaxation)(figures, shown, curve);
  }
  return figures;
}

}  // namespace isotach::reports
