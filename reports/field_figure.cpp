// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/field_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "reports/number.hpp"
#include "reports/slump_tables.hpp"

namespace isotach::reports {
namespace {

constexpr std::size_t kMostColumns = 3;
constexpr double kGap = 28.0;            // px between panels
constexpr double kRowGap = 6.0;          // px; numbers along r are where no panel is below
constexpr double kPanelTitle = 22.0;     // px
constexpr double kTallestPanel = 300.0;  // px
constexpr double kBarShare = 0.6;        // of the width, for the colour bar

}  // namespace

std::string limits_text(FieldQuantity quantity, const ColourScale& colours) {
  const bool logarithmic = colours.axis().logarithmic;
  const int digits = logarithmic ? 1 : 2;  // decades need no more
  const std::string_view unit = unit_name(quantity);
  return fmt::format("Colours are {} from {} to {}{}{}; values beyond have the colour of the limit.",
                     logarithmic ? "logarithmic" : "linear", format_number(colours.scale().min(), digits),
                     format_number(colours.scale().max(), digits), unit.empty() ? "" : " ", unit);
}

Drawing field_figure(FieldQuantity quantity, std::span<const mpm::Frame> frames, const mpm::Mould& mould) {
  if (frames.empty()) throw std::invalid_argument("a figure of fields without frames");
  const double radius = 0.5 * mould.diameter;
  const ColourScale colours = colours_of(quantity, frames);
  MapArea area = MapArea::around(frames, radius, mould.fill_height);
  const std::size_t columns = frames.size() == 4 ? 2 : std::min(frames.size(), kMostColumns);
  const std::size_t rows = (frames.size() + columns - 1) / columns;
  const auto n = static_cast<double>(columns);
  const double panel_width = (kDrawingWidth - kRoomLeft - n * kGap) / n;
  area.scale = std::min(panel_width / area.r_max, kTallestPanel / area.z_max);
  const double used = n * area.width() + (n - 1.0) * kGap;
  const double first_left = kRoomLeft + 0.5 * (kDrawingWidth - kRoomLeft - kGap - used);
  const double row_height = kPanelTitle + area.height() + kRowGap;
  const double bar_top = static_cast<double>(rows) * row_height + kRoomForNumbers + kRoomForLabel + 8.0;

  pugi::xml_document document;
  pugi::xml_node svg = start_drawing(document, kDrawingWidth, bar_top + kColourBarHeight, name_of(quantity));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::size_t column = k % columns;
    area.left = first_left + static_cast<double>(column) * (area.width() + kGap);
    area.top = static_cast<double>(k / columns) * row_height + kPanelTitle;
    pugi::xml_node panel = svg.append_child("g");
    panel.append_attribute("class") = "panel";
    add_text(panel, area.left + 0.5 * area.width(), area.top - 7.0, TextAnchor::middle,
             time_label(frames[k].time));
    add_map(panel, area, frames[k], quantity, colours, radius);
    add_axes(panel, area, {.r = k + columns >= frames.size(), .z = column == 0});
  }
  const double bar_width = kBarShare * kDrawingWidth;
  add_colour_bar(svg, 0.5 * (kDrawingWidth - bar_width), bar_top, bar_width, colours);

  std::string caption(name_of(quantity));
  caption.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(caption.front())));
  caption +=
      " at output times: averages over cells that the mud fills by half or more, its outline, and the "
      "mould where it is still there. " +
      limits_text(quantity, colours);
  return {text_of(document), std::move(caption)};
}

}  // namespace isotach::reports
