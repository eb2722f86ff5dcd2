// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Layout, look and data of a figure in gnuplot's language.
#include "reports/figure_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <unordered_set>

#include "reports/axis_scale.hpp"
#include "reports/gnuplot.hpp"

namespace isotach::reports {
namespace {

// Sizes in pixels of the SVG, which is as wide as the page's column: what is legible here is so on the page.
constexpr int kFullWidth = 720;
constexpr int kHalfWidth = 352;
constexpr int kSides = 80;  // what the y axis takes beside the frame
constexpr int kTop = 14;
constexpr double kBottom = 48;  // ticks and label of the x axis
constexpr int kTitleHeight = 24;
constexpr int kLegendRow = 18;
// gnuplot reckons with letters of 8.4 px at 12 px of font, and 5.5 of them for a legend's line sample and
// gaps. They are narrower in any sans serif, so each label is counted shorter.
constexpr double kLetterWidth = 8.4;
constexpr double kLegendSample = 5.5;   // letters
constexpr double kLetterExcess = 0.24;  // of kLetterWidth
constexpr double kTallest = 0.75;       // height to width of the frame with equal aspect
constexpr double kFlattest = 0.15;

// Points in one cell of this size look like one.
constexpr double kLineCell = 0.25;
constexpr double kPointCell = 1.0;

struct Scales {
  AxisScale x;
  AxisScale y;
};

int width_of(const Figure& figure) {
  return figure.width == FigureWidth::full ? kFullWidth : kHalfWidth;
}

Scales scales_of(const Figure& figure) {
  std::vector<double> xs;
  std::vector<double> ys;
  for (const Series& series : figure.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!can_show(figure.x, series.x[i]) || !can_show(figure.y, series.y[i])) continue;
      xs.push_back(series.x[i]);
      ys.push_back(series.y[i]);
      if (series.y_error.empty()) continue;
      ys.push_back(series.y[i] - series.y_error[i]);
      ys.push_back(series.y[i] + series.y_error[i]);
    }
  }
  for (const MarkerLine& marker : figure.markers) {
    (marker.direction == MarkerLine::Direction::vertical ? xs : ys).push_back(marker.at);
  }
  for (const Annotation& annotation : figure.annotations) {
    xs.push_back(annotation.x);
    ys.push_back(annotation.y);
  }
  return {{figure.x, xs}, {figure.y, ys}};
}

/// Length of UTF-8 text in characters.
std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

bool in_legend(const Series& series) {
  return series.in_legend && !series.label.empty();
}

/// Columns and rows of the legend; rows are zero where there is none.
struct Legend {
  int columns = 0;
  int rows = 0;
  double shortened = 0.0;  // letters, added to the length of each label
  [[nodiscard]] double height() const { return rows == 0 ? 0.0 : rows * kLegendRow + 8.0; }
};

Legend legend_of(const Figure& figure) {
  std::size_t longest = 0;
  int entries = 0;
  for (const Series& series : figure.series) {
    if (!in_legend(series)) continue;
    ++entries;
    longest = std::max(longest, characters(series.label));
  }
  if (entries == 0) return {};
  const double shortened = -kLetterExcess * static_cast<double>(longest);
  const double entry_width = kLetterWidth * (kLegendSample + static_cast<double>(longest) + shortened);
  const int fitting = static_cast<int>((width_of(figure) - 24) / entry_width);
  const int columns = std::clamp(fitting, 1, entries);
  return {columns, (entries + columns - 1) / columns, shortened};
}

int height_of(const Figure& figure, const Scales& scales, const Legend& legend) {
  double ratio = figure.height_to_width;
  if (figure.equal_aspect) {
    const double spans = (scales.y.max() - scales.y.min()) / (scales.x.max() - scales.x.min());
    ratio = std::clamp(spans, kFlattest, kTallest);
  }
  const int title = figure.title.empty() ? 0 : kTitleHeight;
  return static_cast<int>(ratio * (width_of(figure) - kSides)) + kTop +
         static_cast<int>(kBottom + legend.height()) + title;
}

std::string axis_commands(char name, const Axis& axis, const AxisScale& scale, int labels) {
  std::string text = fmt::format("set {}label {} noenhanced{}\n", name, gnuplot_quoted(axis.label),
                                 name == 'x' ? " offset 0,0.5" : "");
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  const double first = axis.reversed ? scale.max() : scale.min();
  const double last = axis.reversed ? scale.min() : scale.max();
  text += fmt::format("set {}range [{}:{}]\nset {}tics (", name, first, last, name);
  const char* separator = "";
  for (const Tick& tick : scale.ticks(labels)) {
    // The level after the value: 0 is a major tick with a grid line, 1 a minor one.
    text += fmt::format("{}{} {} {}", separator, gnuplot_quoted(tick.label), tick.value,
                        tick.label.empty() ? 1 : 0);
    separator = ", ";
  }
  return text + ")\n";
}

std::string marker_commands(const MarkerLine& marker, const Figure& figure) {
  const bool vertical = marker.direction == MarkerLine::Direction::vertical;
  if (!can_show(vertical ? figure.x : figure.y, marker.at)) return {};
  const std::string line = vertical ? fmt::format("first {0}, graph 0 to first {0}, graph 1", marker.at)
                                    : fmt::format("graph 0, first {0} to graph 1, first {0}", marker.at);
  const std::string label =
      vertical ? fmt::format("first {}, graph 0.98 right rotate by 90 offset character 1.2,0", marker.at)
               : fmt::format("graph 0.99, first {} right offset character 0,0.5", marker.at);
  return fmt::format(
      "set arrow from {} nohead lc rgb '#808080' lw 1 dt (6,4) front\n"
      "set label {} at {} noenhanced tc rgb '#606060' font ',11' front\n",
      line, gnuplot_quoted(marker.label), label);
}

/// The points of a series as gnuplot reads them: x and y; blank lines part the line. Empty where there is
/// nothing to show.
std::string point_rows(const Series& series, const Scales& scales, const Figure& figure) {
  const bool lone_points = series.style == SeriesStyle::points || series.style == SeriesStyle::open_points ||
                           series.style == SeriesStyle::dots || series.style == SeriesStyle::discs;
  const double cells = width_of(figure) / (lone_points ? kPointCell : kLineCell);
  const auto cell = [&](std::size_t i) {
    const auto index = [&](double position) {
      return static_cast<std::int64_t>(std::clamp(std::floor(position * cells), -1e9, 1e9));
    };
    return index(scales.x.position(series.x[i])) * 4'000'000'000 + index(scales.y.position(series.y[i]));
  };
  std::string rows;
  std::unordered_set<std::int64_t> taken;
  bool gap = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!can_show(figure.x, series.x[i]) || !can_show(figure.y, series.y[i])) {
      gap = true;
      if (!lone_points) taken.clear();
      continue;
    }
    if (!taken.insert(cell(i)).second) continue;
    if (gap && !rows.empty()) rows += '\n';
    gap = false;
    fmt::format_to(std::back_inserter(rows), "{} {}\n", series.x[i], series.y[i]);
    // A line may come back to a cell it has left; only runs of points in the same cell are one point.
    if (!lone_points) {
      taken.clear();
      taken.insert(cell(i));
    }
  }
  return rows;
}

/// Error bars as two-point lines parted by blank lines: gnuplot's own bars blank out what lies behind the
/// point.
std::string bar_rows(const Series& series, const Scales& scales, const Figure& figure) {
  std::string rows;
  for (std::size_t i = 0; i < series.y_error.size(); ++i) {
    const double low = series.y[i] - series.y_error[i];
    const double high = series.y[i] + series.y_error[i];
    if (!can_show(figure.x, series.x[i]) || !can_show(figure.y, high) || !std::isfinite(low)) continue;
    // One that reaches below what a logarithmic axis can show ends at the end of the axis.
    const double end = can_show(figure.y, low) ? low : scales.y.min();
    fmt::format_to(std::back_inserter(rows), "{0} {1}\n{0} {2}\n\n", series.x[i], end, high);
  }
  return rows;
}

std::string look(const Series& series, std::size_t place) {
  // Circle, square, triangle, diamond, inverted triangle: the filled one; the outlined one is its
  // predecessor.
  static constexpr int kFilledMarkers[] = {7, 5, 9, 13, 11};
  const int filled = kFilledMarkers[place % std::size(kFilledMarkers)];
  switch (series.style) {
    case SeriesStyle::line:
      return "lines lw 1.8";
    case SeriesStyle::dashed:
      return "lines lw 1.8 dt (9,5)";
    case SeriesStyle::dotted:
      return "lines lw 1.8 dt (2,4)";
    case SeriesStyle::thin_dashed:
      return "lines lw 0.9 dt (6,4)";
    case SeriesStyle::points:
      return fmt::format("points pt {} ps 0.55", filled);
    case SeriesStyle::open_points:
      return fmt::format("points pt {} ps 0.6 lw 1.2", filled - 1);
    case SeriesStyle::dots:
      return "points pt 7 ps 0.22";
    case SeriesStyle::discs:
      return "points pt 7 ps 0.42";
    case SeriesStyle::line_points:
      return fmt::format("linespoints lw 1.3 pt {} ps 0.5", filled);
  }
  return {};
}

/// What of a series has data to draw.
struct Drawn {
  bool points;
  bool bars;
};

std::string plot_command(const Figure& figure, const std::vector<Drawn>& drawn) {
  std::string text = "plot NaN notitle";  // so that there is something to plot in any case
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    const Series& series = figure.series[i];
    const Rgb rgb = series.colour.value_or(palette_colour(i));
    const std::string colour = fmt::format("lc rgb '#{:02x}{:02x}{:02x}'", rgb.red, rgb.green, rgb.blue);
    const std::string style = look(series, i);
    const bool keyed = in_legend(series);
    const std::string title =
        keyed ? fmt::format("title {} noenhanced", gnuplot_quoted(series.label)) : "notitle";
    if (drawn[i].bars) text += fmt::format(", $bars{} using 1:2 with lines lw 1 {} notitle", i, colour);
    // Dots are too small to be recognised in the legend, which shows them larger.
    const bool own_key = keyed && (series.style == SeriesStyle::dots || !drawn[i].points);
    if (drawn[i].points) {
      text +=
          fmt::format(", $points{} using 1:2 with {} {} {}", i, style, colour, own_key ? "notitle" : title);
    }
    if (own_key) {
      const std::string sample = series.style == SeriesStyle::dots ? "points pt 7 ps 0.5" : style;
      text += fmt::format(", keyentry with {} {} {}", sample, colour, title);
    }
  }
  return text + "\n";
}

}  // namespace

std::string figure_script(const Figure& figure) {
  const Scales scales = scales_of(figure);
  const Legend legend = legend_of(figure);
  const int height = height_of(figure, scales, legend);
  std::string script = fmt::format(
      "reset\nset encoding utf8\nset minussign\n"
      "set terminal svg enhanced size {},{} font 'sans-serif,12'\n"
      "set border 3 lw 0.8 lc rgb '#606060'\nset tics nomirror out scale 0.5,0.25\n"
      "set grid xtics ytics lt 1 dt solid lw 0.6 lc rgb '#e2e2e2'\n"
      "set clip two\nset rmargin 2\nset xtics offset 0,0.3\n",
      width_of(figure), height);
  if (figure.equal_aspect) script += "set size ratio -1\n";
  if (!figure.title.empty())
    script += fmt::format("set title {} noenhanced font ',13'\n", gnuplot_quoted(figure.title));
  // The bottom is laid out by hand: gnuplot would let legend and axis label touch.
  script += fmt::format("set bmargin at screen {}\n", (kBottom + legend.height()) / height);
  script += legend.rows == 0
                ? std::string("set key off\n")
                : fmt::format(
                      "set key at screen 0.53, screen {} center bottom horizontal Left reverse samplen 2.5 "
                      "width {} maxcols {}\n",
                      2.0 / height, legend.shortened, legend.columns);
  const bool full = figure.width == FigureWidth::full;
  script += axis_commands('x', figure.x, scales.x, full ? 10 : 5);
  script += axis_commands('y', figure.y, scales.y, std::clamp(height / 36, 3, 8));
  for (const MarkerLine& marker : figure.markers) script += marker_commands(marker, figure);
  for (const Annotation& annotation : figure.annotations) {
    if (!can_show(figure.x, annotation.x) || !can_show(figure.y, annotation.y)) continue;
    script += fmt::format("set label {} at first {}, first {} noenhanced tc rgb '#404040' font ',11' front\n",
                          gnuplot_quoted(annotation.text), annotation.x, annotation.y);
  }
  std::vector<Drawn> drawn;
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    const std::string points = point_rows(figure.series[i], scales, figure);
    const std::string bars = bar_rows(figure.series[i], scales, figure);
    if (!points.empty()) script += fmt::format("$points{} << EOD\n{}EOD\n", i, points);
    if (!bars.empty()) script += fmt::format("$bars{} << EOD\n{}EOD\n", i, bars);
    drawn.push_back({!points.empty(), !bars.empty()});
  }
  if (std::none_of(drawn.begin(), drawn.end(), [](const Drawn& series) { return series.points; })) {
    script += "set label 'no data to show' at graph 0.5, graph 0.5 center tc rgb '#606060'\n";
  }
  return script + plot_command(figure, drawn);
}

}  // namespace isotach::reports
