// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/field_animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reports/field_figure.hpp"
#include "reports/number.hpp"
#include "reports/slump_tables.hpp"

namespace isotach::reports {
namespace {

constexpr double kTallest = 400.0;       // px, of the map
constexpr double kHead = 58.0;           // px above the map: time and bar
constexpr double kBarTop = 26.0;         // px
constexpr double kProgressHeight = 6.0;  // px
constexpr double kRight = 20.0;          // px
constexpr double kNarrowest = 320.0;     // px, of a map

/// A time (s) with two digits, such as a moving eye can read.
std::string clock(double time) {
  return time < 1e-3 ? "0" : format_number(time, 2);
}

/// Place of a time in the loop, 0 to 1.
double place_of(double time, double end) {
  return std::log1p(time / mpm::kFrameTimeScale) / std::log1p(end / mpm::kFrameTimeScale);
}

pugi::xml_node add_bar(pugi::xml_node parent, double left, double width, const char* colour) {
  pugi::xml_node bar = parent.append_child("rect");
  bar.append_attribute("x") = left;
  bar.append_attribute("y") = kBarTop;
  bar.append_attribute("width") = fmt::format("{:.1f}", width).c_str();
  bar.append_attribute("height") = kProgressHeight;
  bar.append_attribute("fill") = colour;
  return bar;
}

/// The bar's ground, with times along it.
void add_time_line(pugi::xml_node svg, double left, double width, double end) {
  add_bar(svg, left, width, "#d4d9de");
  for (const double time : {0.0, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0}) {
    if (time > end * (1.0 + 1e-9)) break;
    pugi::xml_node text = add_text(svg, left + width * place_of(time, end), kBarTop + kProgressHeight + 13.0,
                                   TextAnchor::middle, time_label(time));
    text.append_attribute("font-size") = 11;
  }
}

// On paper, and for those who asked for less motion: the last frame alone. What is important stands above
// animation.
constexpr const char* kStill =
    ".frame{visibility:hidden!important}.frame:last-of-type{visibility:visible!important}";

/// Shows the group from `from` to `to`, parts of the loop.
void show_between(pugi::xml_node group, double from, double to) {
  const bool last = to >= 1.0;
  // where nothing moves
  group.append_attribute("visibility") = last ? "visible" : "hidden";
  pugi::xml_node animate = group.append_child("animate");
  animate.append_attribute("attributeName") = "visibility";
  animate.append_attribute("calcMode") = "discrete";
  animate.append_attribute("dur") = fmt::format("{:g}s", kLoop).c_str();
  animate.append_attribute("repeatCount") = "indefinite";
  std::string values = from > 0.0 ? "hidden;visible" : "visible";
  std::string times = from > 0.0 ? fmt::format("0;{:.5f}", from) : "0";
  if (!last) {
    values += ";hidden";
    times += fmt::format(";{:.5f}", to);
  }
  animate.append_attribute("values") = values.c_str();
  animate.append_attribute("keyTimes") = times.c_str();
}

}  // namespace

Drawing field_animation(FieldQuantity quantity, std::span<const mpm::Frame> frames, const mpm::Mould& mould) {
  if (frames.empty()) throw std::invalid_argument("an animation without frames");
  const double radius = 0.5 * mould.diameter;
  const double end = frames.back().time;
  const ColourScale colours = colours_of(quantity, frames);
  MapArea area = MapArea::around(frames, radius, mould.fill_height);
  const double room = kDrawingWidth - kRoomLeft - kRight;
  area.scale = std::min(room / area.r_max, kTallest / area.z_max);
  area.top = kHead;
  // time and colours need some width even where the map is narrow
  const double used = std::max(area.width(), kNarrowest);
  const double left = kRoomLeft + 0.5 * (room - used);
  area.left = left + 0.5 * (used - area.width());
  const double bar_top = kHead + area.height() + kRoomForNumbers + kRoomForLabel + 6.0;

  pugi::xml_document document;
  pugi::xml_node svg = start_drawing(document, kDrawingWidth, bar_top + kColourBarHeight,
                                     fmt::format("{} through time, animated", name_of(quantity)));
  svg.append_child("style").text().set(
      fmt::format("@media print{{{0}}}@media (prefers-reduced-motion:reduce){{{0}}}", kStill).c_str());
  add_time_line(svg, left, used, end);
  add_colour_bar(svg, left, bar_top, used, colours);
  const double turn =
      frames.size() > 1 ? (1.0 - kLastFrame / kLoop) / static_cast<double>(frames.size() - 1) : 1.0;
  pugi::xml_node all = svg.append_child("g");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const mpm::Frame& frame = frames[k];
    pugi::xml_node group = all.append_child("g");
    group.append_attribute("class") = "frame";
    const double from = static_cast<double>(k) * turn;
    show_between(group, from, k + 1 == frames.size() ? 1.0 : from + turn);
    add_map(group, area, frame, quantity, colours, radius);
    add_bar(group, left, used * place_of(frame.time, end), "#5a6570");
    add_text(group, left + 0.5 * used, 16.0, TextAnchor::middle, fmt::format("t = {} s", clock(frame.time)))
        .append_attribute("font-weight") = "bold";
  }
  add_axes(svg, area, {});

  return {text_of(document),
          fmt::format("The slump as it goes, again and again: {}, outline and mould. {:g} s a loop; time is "
                      "compressed, in even steps of ln(1 + t/{:g} s), so that the fast beginning can be "
                      "followed and what is slow does not take long; the end stands for {:g} s. {}",
                      name_of(quantity), kLoop, mpm::kFrameTimeScale, kLastFrame,
                      limits_text(quantity, colours))};
}

}  // namespace isotach::reports
