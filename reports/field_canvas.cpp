// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/field_canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "reports/indexed_png.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

constexpr double kMargin = 1.04;          // of an area around what it shows
constexpr double kTick = 4.0;             // px
constexpr double kTickDistance = 45.0;    // px between numbers, at least
constexpr double kOutlineDistance = 0.7;  // px between points of an outline, at least
constexpr double kBarHeight = 12.0;       // px
constexpr const char* kInk = "#1d2329";
constexpr const char* kWall = "#5a6570";
constexpr const char* kFontFamily = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

const std::vector<float>& values_of(FieldQuantity quantity, const mpm::FieldMap& map) {
  switch (quantity) {
    case FieldQuantity::strain_rate_norm:
      return map.strain_rate_norm;
    case FieldQuantity::overconsolidation_ratio:
      return map.overconsolidation_ratio;
    case FieldQuantity::pore_pressure:
      break;
  }
  return map.pore_pressure;
}

/// From the map's unit to the shown one.
double unit_of(FieldQuantity quantity) {
  return quantity == FieldQuantity::pore_pressure ? 1e-3 : 1.0;
}

/// A coordinate (px) as text, to a tenth.
std::string coordinate(double px) {
  return fmt::format("{:g}", std::round(10.0 * px) / 10.0);
}

void set(pugi::xml_node node, const char* name, double px) {
  node.append_attribute(name) = coordinate(px).c_str();
}

void add_line(pugi::xml_node parent, double x1, double y1, double x2, double y2) {
  pugi::xml_node line = parent.append_child("line");
  set(line, "x1", x1);
  set(line, "y1", y1);
  set(line, "x2", x2);
  set(line, "y2", y2);
}

/// Numbers along a length of px, no closer than can be read.
int tick_count(double px) {
  return std::max(2, static_cast<int>(px / kTickDistance));
}

/// Map rows go up from the base, those of a picture down from the top.
IndexedImage image_of(const mpm::FieldMap& map, FieldQuantity quantity, const ColourScale& colours) {
  const std::vector<float>& values = values_of(quantity, map);
  IndexedImage image{map.columns, map.rows, {}};
  image.pixels.reserve(values.size());
  for (std::size_t row = map.rows; row-- > 0;) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      image.pixels.push_back(
          colours.level(unit_of(quantity) * static_cast<double>(values[row * map.columns + column])));
    }
  }
  return image;
}

void add_raster(pugi::xml_node parent, const MapArea& area, const mpm::FieldMap& map, FieldQuantity quantity,
                const ColourScale& colours) {
  const double height = static_cast<double>(map.rows) * map.cell_size;
  pugi::xml_node image = parent.append_child("image");
  set(image, "x", area.x(0.0));
  set(image, "y", area.y(height));
  set(image, "width", area.scale * static_cast<double>(map.columns) * map.cell_size);
  set(image, "height", area.scale * height);
  image.append_attribute("preserveAspectRatio") = "none";
  image.append_attribute("style") = "image-rendering:pixelated";
  image.append_attribute("href") = png_uri(image_of(map, quantity, colours), ColourScale::palette()).c_str();
}

void add_outline(pugi::xml_node parent, const MapArea& area, const mpm::Outline& outline) {
  if (outline.points.empty()) return;
  std::string path;
  double last_x = 0.0;
  double last_y = 0.0;
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const double x = area.x(outline.points[i].r);
    const double y = area.y(outline.points[i].z);
    const bool end = i == 0 || i + 1 == outline.points.size();
    if (!end && std::hypot(x - last_x, y - last_y) < kOutlineDistance) continue;
    path += fmt::format("{}{} {}", path.empty() ? "M" : "L", coordinate(x), coordinate(y));
    last_x = x;
    last_y = y;
  }
  pugi::xml_node line = parent.append_child("path");
  line.append_attribute("class") = "outline";
  line.append_attribute("d") = path.c_str();
  line.append_attribute("fill") = "none";
  line.append_attribute("stroke") = kInk;
  line.append_attribute("stroke-width") = "1.5";
}

}  // namespace

std::string_view name_of(FieldQuantity quantity) {
  switch (quantity) {
    case FieldQuantity::strain_rate_norm:
      return "strain rate |D|";
    case FieldQuantity::overconsolidation_ratio:
      return "overconsolidation ratio";
    case FieldQuantity::pore_pressure:
      break;
  }
  return "pore pressure";
}

std::string_view unit_name(FieldQuantity quantity) {
  switch (quantity) {
    case FieldQuantity::strain_rate_norm:
      return "1/s";
    case FieldQuantity::overconsolidation_ratio:
      return "";
    case FieldQuantity::pore_pressure:
      break;
  }
  return "kPa";
}

ColourScale colours_of(FieldQuantity quantity, std::span<const mpm::Frame> frames) {
  std::vector<float> values;
  for (const mpm::Frame& frame : frames) {
    for (const float value : values_of(quantity, frame.fields)) {
      if (!std::isnan(value)) values.push_back(static_cast<float>(unit_of(quantity)) * value);
    }
  }
  switch (quantity) {
    case FieldQuantity::strain_rate_norm:
      return ColourScale(logarithmic_limits("strain rate |D| (1/s)", std::move(values)));
    case FieldQuantity::overconsolidation_ratio:
      return ColourScale(linear_limits("overconsolidation ratio OCR (-)", std::move(values)));
    case FieldQuantity::pore_pressure:
      break;
  }
  return ColourScale(linear_limits("pore pressure u (kPa)", std::move(values)));
}

MapArea MapArea::around(std::span<const mpm::Frame> frames, double mould_radius, double fill_height) {
  MapArea area{.r_max = mould_radius, .z_max = 0.0};
  for (const mpm::Frame& frame : frames) {
    const mpm::FieldMap& map = frame.fields;
    area.r_max =
        std::max({area.r_max, frame.outline.toe(), static_cast<double>(map.columns) * map.cell_size});
    area.z_max =
        std::max({area.z_max, frame.outline.height(), static_cast<double>(map.rows) * map.cell_size});
    // a mould that may still hold mud is in the picture
    if (frame.rim < fill_height) area.z_max = std::max(area.z_max, kMargin * frame.rim);
  }
  area.r_max *= kMargin;
  area.z_max *= kMargin;
  return area;
}

pugi::xml_node start_drawing(pugi::xml_document& document, double width, double height,
                             std::string_view title) {
  pugi::xml_node svg = document.append_child("svg");
  svg.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
  svg.append_attribute("viewBox") = fmt::format("0 0 {} {}", coordinate(width), coordinate(height)).c_str();
  set(svg, "width", width);
  set(svg, "height", height);
  svg.append_attribute("style") = "max-width:100%;height:auto";
  svg.append_attribute("font-family") = kFontFamily;
  svg.append_attribute("font-size") = 13;
  svg.append_attribute("fill") = kInk;
  svg.append_attribute("role") = "img";
  svg.append_attribute("aria-label") = std::string(title).c_str();
  return svg;
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream text;
  document.print(text, "", pugi::format_raw | pugi::format_no_declaration);
  return text.str();
}

pugi::xml_node add_text(pugi::xml_node parent, double x, double y, TextAnchor anchor, std::string_view text) {
  pugi::xml_node node = parent.append_child("text");
  set(node, "x", x);
  set(node, "y", y);
  if (anchor != TextAnchor::start) {
    node.append_attribute("text-anchor") = anchor == TextAnchor::middle ? "middle" : "end";
  }
  const std::size_t raised = text.find("^{");
  const std::size_t end = text.find('}', raised);
  node.append_child(pugi::node_pcdata).set_value(std::string(text.substr(0, raised)).c_str());
  if (end == std::string_view::npos) return node;
  pugi::xml_node exponent = node.append_child("tspan");
  exponent.append_attribute("dy") = -5;
  exponent.append_attribute("font-size") = 10;
  exponent.text().set(std::string(text.substr(raised + 2, end - raised - 2)).c_str());
  return node;
}

void add_axes(pugi::xml_node parent, const MapArea& area, AxisLabels labels) {
  pugi::xml_node lines = parent.append_child("g");
  lines.append_attribute("stroke") = kInk;
  pugi::xml_node box = lines.append_child("rect");
  set(box, "x", area.left);
  set(box, "y", area.top);
  set(box, "width", area.width());
  set(box, "height", area.height());
  box.append_attribute("fill") = "none";
  const double bottom = area.y(0.0);
  const AxisScale r({.min = 0.0, .max = kMillimetres * area.r_max}, {});
  for (const Tick& tick : r.ticks(tick_count(area.width()))) {
    const double x = area.x(tick.value / kMillimetres);
    add_line(lines, x, bottom, x, bottom - kTick);
    if (labels.r) add_text(parent, x, bottom + 16.0, TextAnchor::middle, tick.label);
  }
  const AxisScale z({.min = 0.0, .max = kMillimetres * area.z_max}, {});
  for (const Tick& tick : z.ticks(tick_count(area.height()))) {
    const double y = area.y(tick.value / kMillimetres);
    add_line(lines, area.left, y, area.left + kTick, y);
    if (labels.z) add_text(parent, area.left - 6.0, y + 4.5, TextAnchor::end, tick.label);
  }
  if (labels.r) {
    add_text(parent, area.left + 0.5 * area.width(), bottom + kRoomForNumbers + 14.0, TextAnchor::middle,
             "r (mm)");
  }
  if (labels.z) {
    const double x = area.left - 42.0;
    const double y = area.top + 0.5 * area.height();
    add_text(parent, x, y, TextAnchor::middle, "z (mm)").append_attribute("transform") =
        fmt::format("rotate(-90 {} {})", coordinate(x), coordinate(y)).c_str();
  }
}

void add_map(pugi::xml_node parent, const MapArea& area, const mpm::Frame& frame, FieldQuantity quantity,
             const ColourScale& colours, double mould_radius) {
  if (frame.fields.columns > 0) add_raster(parent, area, frame.fields, quantity, colours);
  add_outline(parent, area, frame.outline);
  if (frame.rim >= area.z_max) return;
  pugi::xml_node wall = parent.append_child("line");
  wall.append_attribute("class") = "wall";
  set(wall, "x1", area.x(mould_radius));
  set(wall, "y1", area.y(frame.rim));
  set(wall, "x2", area.x(mould_radius));
  set(wall, "y2", area.top);
  wall.append_attribute("stroke") = kWall;
  wall.append_attribute("stroke-width") = 4;
}

void add_colour_bar(pugi::xml_node parent, double left, double top, double width,
                    const ColourScale& colours) {
  IndexedImage image{ColourScale::kLevels, 1, {}};
  for (int level = 1; level <= ColourScale::kLevels; ++level) {
    image.pixels.push_back(static_cast<std::uint8_t>(level));
  }
  pugi::xml_node bar = parent.append_child("image");
  set(bar, "x", left);
  set(bar, "y", top);
  set(bar, "width", width);
  set(bar, "height", kBarHeight);
  bar.append_attribute("preserveAspectRatio") = "none";
  bar.append_attribute("style") = "image-rendering:pixelated";
  bar.append_attribute("href") = png_uri(image, ColourScale::palette()).c_str();
  pugi::xml_node lines = parent.append_child("g");
  lines.append_attribute("stroke") = kInk;
  for (const Tick& tick : colours.scale().ticks(tick_count(width))) {
    const double x = left + width * colours.scale().position(tick.value);
    if (tick.label.empty()) continue;
    add_line(lines, x, top + kBarHeight, x, top + kBarHeight + kTick);
    add_text(parent, x, top + kBarHeight + 18.0, TextAnchor::middle, tick.label);
  }
  add_text(parent, left + 0.5 * width, top + kColourBarHeight - 4.0, TextAnchor::middle,
           colours.axis().label);
}

}  // namespace isotach::reports
