// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Maps of a body in the meridian plane as SVG: raster, outline, mould, axes and colour bar.
#pragma once

#include <pugixml.hpp>
#include <span>
#include <string_view>

#include "mpm/field_map.hpp"
#include "reports/colour_scale.hpp"

namespace isotach::reports {

/// What maps show.
enum class FieldQuantity {
  strain_rate_norm,         ///< |D| (1/s), logarithmic
  overconsolidation_ratio,  ///< OCR (-)
  pore_pressure,            ///< u (Pa; shown in kPa), compression positive
};

/// The quantity's name in a sentence, "strain rate |D|".
[[nodiscard]] std::string_view name_of(FieldQuantity quantity);

/// The unit that is shown, "1/s"; empty where there is none.
[[nodiscard]] std::string_view unit_name(FieldQuantity quantity);

/// Colours for all the frames, between limits common to them.
[[nodiscard]] ColourScale colours_of(FieldQuantity quantity, std::span<const mpm::Frame> frames);

/// The part of the meridian plane from axis and base to r_max and z_max (m), on paper: where its upper left
/// corner is (px) and how large a metre is, the same along both axes.
struct MapArea {
  double left = 0.0;
  double top = 0.0;
  double scale = 1.0;  ///< px/m
  double r_max = 0.0;
  double z_max = 0.0;

  /// A little more than all the frames and the mould's radius; the rim too, while it is below `fill_height`.
  static MapArea around(std::span<const mpm::Frame> frames, double mould_radius, double fill_height);

  [[nodiscard]] double width() const { return scale * r_max; }   ///< px
  [[nodiscard]] double height() const { return scale * z_max; }  ///< px
  [[nodiscard]] double x(double r) const { return left + scale * r; }
  [[nodiscard]] double y(double z) const { return top + scale * (z_max - z); }
};

/// An empty drawing of that size (px) that scales with the page, without ids, and `title` as its name.
pugi::xml_node start_drawing(pugi::xml_document& document, double width, double height,
                             std::string_view title);
/// The drawing as text.
[[nodiscard]] std::string text_of(const pugi::xml_document& document);

enum class TextAnchor { start, middle, end };
/// Text at a point of its base line; ^{...} is raised.
pugi::xml_node add_text(pugi::xml_node parent, double x, double y, TextAnchor anchor, std::string_view text);

/// Which sides of an area have numbers and a label.
struct AxisLabels {
  bool r = true;
  bool z = true;
};
/// Frame, ticks and labels in mm.
void add_axes(pugi::xml_node parent, const MapArea& area, AxisLabels labels);

/// The quantity, the outline, and the mould's wall as far as it is above the rim.
void add_map(pugi::xml_node parent, const MapArea& area, const mpm::Frame& frame, FieldQuantity quantity,
             const ColourScale& colours, double mould_radius);

/// The colours from left to right with their numbers and what they are of below.
void add_colour_bar(pugi::xml_node parent, double left, double top, double width, const ColourScale& colours);
/// Height of a colour bar with its text (px).
inline constexpr double kColourBarHeight = 52.0;

/// What maps need besides their areas (px): room at the left of an area for numbers and label, below it for
/// numbers, and for the label.
inline constexpr double kRoomLeft = 58.0;
inline constexpr double kRoomForNumbers = 20.0;
inline constexpr double kRoomForLabel = 20.0;
inline constexpr double kDrawingWidth = 720.0;  ///< as wide as figures across a page

}  // namespace isotach::reports
