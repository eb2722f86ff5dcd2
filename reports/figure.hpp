// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a figure shows, as values, and its rendering to SVG by gnuplot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isotach::reports {

struct Rgb {
  std::uint8_t red, green, blue;
};

/// The Okabe-Ito palette, told apart by colour-blind eyes too, without its yellow, which is lost on white:
/// blue, vermilion, green, purple, orange, sky blue, black, and again from the start.
[[nodiscard]] Rgb palette_colour(std::size_t index);

enum class SeriesStyle {
  line,
  dashed,
  dotted,
  thin_dashed,  ///< for lines that stand behind others
  points,       ///< filled markers, whose shape changes with the place in the figure, as the colour does
  open_points,  ///< outlined markers
  dots,         ///< small discs without shape, for thousands of points
  discs,        ///< larger ones
  line_points,  ///< line through filled markers
};

struct Axis {
  std::string label{};          ///< with its unit
  bool logarithmic = false;     ///< values that are not positive are then left out
  bool reversed = false;        ///< increasing to the left or downwards
  std::optional<double> min{};  ///< least value shown; by default what the data need
  std::optional<double> max{};  ///< greatest value shown
};

struct Series {
  std::string label{};  ///< in the legend
  SeriesStyle style = SeriesStyle::line;
  std::vector<double> x{};
  std::vector<double> y{};        ///< as many as x; a point that is not finite is left out and parts the line
  std::vector<double> y_error{};  ///< half lengths of the error bars in the unit of y, one a point, or none
  std::optional<Rgb> colour{};    ///< by default the palette's, by place in the figure
  bool in_legend = true;          ///< needs a label
};

/// A straight line across the figure at one value of an axis, with its name along it.
struct MarkerLine {
  enum class Direction { vertical, horizontal };
  Direction direction = Direction::vertical;
  double at = 0.0;  ///< value on the axis that the line crosses
  std::string label{};
};

/// Text whose left end is at a point.
struct Annotation {
  double x = 0.0;
  double y = 0.0;
  std::string text{};
};

enum class FigureWidth {
  full,  ///< across the page
  half,  ///< two side by side, letters as large as in the other
};

/// A figure as a value; all text is UTF-8 and taken literally.
struct Figure {
  std::string title{};    ///< above the axes; may be empty
  std::string caption{};  ///< below the figure on the page
  Axis x{};
  Axis y{};
  bool equal_aspect =
      false;  ///< one unit is as long on y as on x (both linear); height then follows from the data
  double height_to_width = 0.6;  ///< of the frame, otherwise; 0.1 to 2
  FigureWidth width = FigureWidth::full;
  std::vector<Series> series{};
  std::vector<MarkerLine> markers{};
  std::vector<Annotation> annotations{};
};

/// The figures as `<svg>` elements for one HTML page, scaling with the page; all in one run of gnuplot. Every
/// id in the n-th is prefixed "figure-<first_number + n - 1>-". Points closer than the eye can tell are left
/// out.
///
/// Throws std::invalid_argument for a Figure that contradicts itself (lengths, ranges, equal_aspect on a
/// logarithmic axis) and std::runtime_error, with gnuplot's own words, where gnuplot is missing or fails.
[[nodiscard]] std::vector<std::string> render_svgs(std::span<const Figure> figures, int first_number = 1);

/// One figure, as render_svgs does it.
[[nodiscard]] std::string render_svg(const Figure& figure, int number = 1);

}  // namespace isotach::reports
