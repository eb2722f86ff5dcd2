// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/wandering_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/score_test.hpp"
#include "reports/json_number.hpp"
#include "reports/number.hpp"

namespace isotach::reports {
namespace {

using discovery::WanderCurve;
using discovery::Wandering;
using discovery::WanderingSlot;

constexpr std::size_t kCurvesShown = 4;
/// A change as readers say it: per cent of a quantity, or in its unit.
double shown_change(const WanderingSlot& slot, double change) {
  return slot.slot.logarithmic ? 100.0 * change : change / slot.slot.unit_size;
}

std::string unit_of(const WanderingSlot& slot) {
  return slot.slot.logarithmic ? "100 x change of ln" : fmt::format("change ({})", slot.slot.unit);
}

Figure curve_figure(const WanderingSlot& slot) {
  Figure figure;
  figure.caption = fmt::format(
      "{}: what it would have to do ({} directions). Bars: one "
      "standard error of noise.",
      slot.slot.title(), slot.freedom);
  const discovery::WanderAxis& along = *slot.slot.along;
  figure.x = {.label = std::string(along.label), .logarithmic = along.logarithmic};
  figure.y = {.label = unit_of(slot)};
  figure.height_to_width = 0.5;
  for (const WanderCurve& curve : slot.curves) {
    Series series{.label = curve.test, .style = SeriesStyle::line_points, .in_legend = !curve.test.empty()};
    for (std::size_t k = 0; k < curve.at.size(); ++k) {
      series.x.push_back(curve.at[k] / along.unit);
      series.y.push_back(shown_change(slot, curve.change[k]));
      series.y_error.push_back(shown_change(slot, curve.std_error[k]));
    }
    figure.series.push_back(std::move(series));
  }
  figure.markers = {{MarkerLine::Direction::horizontal, 0.0, ""}};
  return figure;
}

}  // namespace

std::string wander_words(const Wandering& wandering) {
  const WanderingSlot& best = wandering.slots.front();
  double least = 0.0;
  double most = 0.0;
  for (const WanderCurve& curve : best.curves) {
    for (const double change : curve.change) {
      least = std::min(least, change);
      most = std::max(most, change);
    }
  }
  const std::string range =
      best.slot.logarithmic ? fmt::format("by factors from {:.2g} to {:.2g}", std::exp(least), std::exp(most))
                            : fmt::format("by {:+.2g} to {:+.2g} {}", least / best.slot.unit_size,
                                          most / best.slot.unit_size, best.slot.unit);
  return fmt::format("Of single slots, {} would close the gap best, to first order wandering {} ({}).",
                     best.slot.title(), range, discovery::p_words(wandering.p_value));
}

void add_wandering(Page& page, const Wandering& wandering, const std::string& words) {
  page.section("One slot at a time");
  page.paragraph(words);
  Table table{
      .caption = "How much each would gain, the most telling first.",
      .header = {"slot", "over", "directions", "gain of chi-squared", "stands out"},
      .alignment = {Alignment::left, Alignment::left, Alignment::right, Alignment::right, Alignment::right}};
  for (const WanderingSlot& slot : wandering.slots) {
    table.rows.push_back({std::string(slot.slot.name), std::string(slot.slot.along->name),
                          fmt::format("{}", slot.freedom), format_number(slot.gain, 3),
                          slot.freedom > 0 ? format_number(slot.stands_out, 3) : kMissing});
  }
  table.notes.push_back(fmt::format(
      "Stands out: the gain as a deviate of the normal distribution. Noise alone makes the first stand out "
      "as "
      "far with {} (parametric bootstrap). Directions: those that a change of plausible size shows by one "
      "sigma and the base's parameters cannot follow.",
      discovery::p_words(wandering.p_value)));
  page.table(std::move(table));
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < std::min(kCurvesShown, wandering.slots.size()); ++k) {
    if (wandering.slots[k].freedom > 0) figures.push_back(curve_figure(wandering.slots[k]));
  }
  page.figures(std::move(figures));
}

nlohmann::ordered_json wandering_json(const Wandering& wandering) {
  nlohmann::ordered_json json{{"p_value", json_number(wandering.p_value)},
                              {"slots", nlohmann::ordered_json::array()}};
  for (const WanderingSlot& slot : wandering.slots) {
    nlohmann::ordered_json one{{"slot", slot.slot.name},
                               {"along", slot.slot.along->name},
                               {"directions", slot.freedom},
                               {"gain", json_number(slot.gain)},
                               {"p_value", json_number(slot.p_value)},
                               {"stands_out", json_number(slot.stands_out)},
                               {"curves", nlohmann::ordered_json::array()}};
    for (const WanderCurve& curve : slot.curves) {
      nlohmann::ordered_json points = nlohmann::ordered_json::array();
      for (std::size_t k = 0; k < curve.at.size(); ++k) {
        points.push_back({{"at", json_number(curve.at[k])},
                          {"change", json_number(curve.change[k])},
                          {"std_error", json_number(curve.std_error[k])}});
      }
      nlohmann::ordered_json polygon;
      if (!curve.test.empty()) polygon["experiment"] = curve.test;
      polygon["points"] = std::move(points);
      one["curves"].push_back(std::move(polygon));
    }
    json["slots"].push_back(std::move(one));
  }
  return json;
}

}  // namespace isotach::reports
