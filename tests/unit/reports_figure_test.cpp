// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of figures: where curves lie in the SVG, and that it can stand in a page.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "reports/axis_scale.hpp"
#include "reports/figure.hpp"
#include "reports/gnuplot.hpp"

namespace isotach::reports {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPixel = 0.02;  // gnuplot writes hundredths of a pixel

struct Curve {
  std::vector<std::pair<double, double>> points;  // pixels, y downwards
  int strokes = 0;                                // parts that the line falls into
};

pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(svg.c_str()));
  return xml;
}

/// The path of the first series, which must not be in the legend.
Curve first_curve(const Figure& figure) {
  const pugi::xml_document xml = parsed(render_svg(figure));
  const std::string path =
      xml.select_node("//g[@id='figure-1-gnuplot_plot_2']//path").node().attribute("d").value();
  Curve curve;
  std::istringstream words(path);
  for (std::string word; words >> word;) {
    curve.strokes += word[0] == 'M' ? 1 : 0;
    if (word[0] == 'M' || word[0] == 'L') word.erase(0, 1);
    const std::size_t comma = word.find(',');
    curve.points.emplace_back(std::stod(word), std::stod(word.substr(comma + 1)));
  }
  return curve;
}

Figure line(std::vector<double> x, std::vector<double> y) {
  Figure figure;
  figure.series = {{.label = "", .x = std::move(x), .y = std::move(y)}};
  return figure;
}

TEST(Figure, LinearAxesKeepProportions) {
  const Curve curve = first_curve(line({0.0, 1.0, 4.0}, {2.0, 3.0, 6.0}));
  ASSERT_EQ(curve.points.size(), 3U);
  EXPECT_NEAR(curve.points[2].first - curve.points[0].first,
              4.0 * (curve.points[1].first - curve.points[0].first), 5.0 * kPixel);
  EXPECT_NEAR(curve.points[2].second - curve.points[0].second,
              4.0 * (curve.points[1].second - curve.points[0].second), 5.0 * kPixel);
  EXPECT_LT(curve.points[2].second, curve.points[0].second);  // up is up
}

TEST(Figure, LogarithmicAxisSpacesDecadesEqually) {
  Figure figure = line({1.0, 10.0, 100.0}, {0.0, 1.0, 2.0});
  figure.x.logarithmic = true;
  const Curve curve = first_curve(figure);
  ASSERT_EQ(curve.points.size(), 3U);
  EXPECT_NEAR(curve.points[1].first - curve.points[0].first, curve.points[2].first - curve.points[1].first,
              2.0 * kPixel);
}

TEST(Figure, ReversedAxesGrowLeftAndDown) {
  Figure figure = line({0.0, 1.0}, {0.0, 1.0});
  figure.x.reversed = figure.y.reversed = true;
  const Curve curve = first_curve(figure);
  ASSERT_EQ(curve.points.size(), 2U);
  EXPECT_LT(curve.points[1].first, curve.points[0].first);
  EXPECT_GT(curve.points[1].second, curve.points[0].second);
}

TEST(Figure, EqualAspectDrawsASquareSquare) {
  for (const double width : {1.0, 3.0, 20.0}) {
    Figure figure = line({0.0, 1.0, 1.0, width}, {0.0, 0.0, 1.0, 2.0});
    figure.equal_aspect = true;
    const Curve curve = first_curve(figure);
    ASSERT_EQ(curve.points.size(), 4U);
    const double across = curve.points[1].first - curve.points[0].first;
    const double up = curve.points[1].second - curve.points[2].second;
    EXPECT_GT(across, 10.0);
    EXPECT_NEAR(across, up, 0.005 * across + 2.0 * kPixel) << width;
  }
}

TEST(Figure, PointsThatAreNotFinitePartTheLine) {
  const Curve curve = first_curve(line({0.0, 1.0, 2.0, 3.0, 4.0}, {0.0, 1.0, kNaN, 3.0, 4.0}));
  EXPECT_EQ(curve.points.size(), 4U);
  EXPECT_EQ(curve.strokes, 2);
  Figure logarithmic = line({0.0, 1.0, 2.0, 3.0, 4.0}, {1.0, 2.0, -1.0, 3.0, 4.0});
  logarithmic.y.logarithmic = true;
  EXPECT_EQ(first_curve(logarithmic).strokes, 2);
}

TEST(Figure, AGivenRangeIsKept) {
  // Half of the range is half of the frame: 5 lies midway between the marks of 0 and 10.
  Figure figure = line({0.0, 5.0, 10.0}, {0.0, 1.0, 0.0});
  figure.x.min = 0.0;
  figure.x.max = 20.0;
  const Curve curve = first_curve(figure);
  const pugi::xml_document xml = parsed(render_svg(figure));
  const std::string tick =
      xml.select_node("//text[normalize-space()='20']/..").node().attribute("transform").value();
  ASSERT_TRUE(tick.starts_with("translate("));
  EXPECT_NEAR(std::stod(tick.substr(10)) - curve.points[0].first,
              2.0 * (curve.points[2].first - curve.points[0].first), 4.0 * kPixel);
}

std::size_t marks(const Figure& figure) {
  return parsed(render_svg(figure)).select_nodes("//g[@id='figure-1-gnuplot_plot_2']//use").size();
}

TEST(Figure, DrawsOneMarkAPointAndDropsOnlyWhatCoincides) {
  Figure figure = line({0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 2.0, 3.0});
  figure.series[0].style = SeriesStyle::points;
  EXPECT_EQ(marks(figure), 4U);

  figure.series[0].style = SeriesStyle::dots;
  figure.series[0].x.resize(50'004, 3.0);
  figure.series[0].y.resize(50'004, 3.0);
  EXPECT_EQ(marks(figure), 4U);
}

TEST(Figure, ALineMayRetraceItself) {
  EXPECT_EQ(first_curve(line({0.0, 1.0, 0.0, 1.0}, {0.0, 1.0, 0.0, 1.0})).points.size(), 4U);
}

TEST(Figure, LongLinesAreThinnedButKeepTheirShape) {
  // The limaçon r = 1 + 2 cos, which is closed.
  std::vector<double> x;
  std::vector<double> y;
  const int n = 200'000;
  for (int i = 0; i <= n; ++i) {
    const double angle = 6.283185307179586 * i / n;
    const double radius = 1.0 + 2.0 * std::cos(angle);
    x.push_back(radius * std::cos(angle));
    y.push_back(radius * std::sin(angle));
  }
  const Curve curve = first_curve(line(x, y));
  EXPECT_LT(curve.points.size(), 20'000U);
  EXPECT_GT(curve.points.size(), 500U);
  EXPECT_EQ(curve.strokes, 1);
  EXPECT_NEAR(curve.points.back().first, curve.points.front().first, 1.0);
  EXPECT_NEAR(curve.points.back().second, curve.points.front().second, 1.0);
}

TEST(Figure, ErrorBarsReachAsFarAsSaid) {
  Figure figure = line({0.0, 1.0}, {0.0, 4.0});
  figure.series[0].style = SeriesStyle::points;
  figure.series[0].y_error = {1.0, kNaN};
  const Curve bars = first_curve(figure);  // the bars come before the marks
  const pugi::xml_document xml = parsed(render_svg(figure));
  std::vector<double> mark_y;
  for (const auto& use : xml.select_nodes("//g[@id='figure-1-gnuplot_plot_3']//use")) {
    const std::string transform = use.node().attribute("transform").value();
    mark_y.push_back(std::stod(transform.substr(transform.find(',') + 1)));
  }
  ASSERT_EQ(mark_y.size(), 2U);
  const double unit = (mark_y[0] - mark_y[1]) / 4.0;
  double top = 1e9;
  double bottom = -1e9;
  for (const auto& [x, y] : bars.points) {
    if (std::abs(x - bars.points.front().first) > 10.0) continue;  // the other point's
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  EXPECT_NEAR(top, mark_y[0] - unit, 3.0 * kPixel);
  EXPECT_NEAR(bottom, mark_y[0] + unit, 3.0 * kPixel);
}

TEST(Figure, TextIsTakenLiterally) {
  const std::filesystem::path trap = std::filesystem::temp_directory_path() / "isotach-figure-trap";
  std::filesystem::remove(trap);
  const std::string text = "a_b^{c} & <d> @e 'f' \"g\" \\h $x `touch " + trap.string() + "` σ′";
  Figure figure = line({0.0, 1.0}, {0.0, 1.0});
  figure.title = "T" + text;
  figure.x.label = "X" + text;
  figure.y.label = "Y" + text;
  figure.series[0].label = "S" + text;
  figure.markers = {{.at = 0.5, .label = "M" + text}};
  figure.annotations = {{0.5, 0.5, "A" + text}};
  const pugi::xml_document xml = parsed(render_svg(figure));
  std::set<std::string> texts;
  for (const auto& node : xml.select_nodes("//text")) texts.insert(node.node().child_value());
  for (const char* mark : {"T", "X", "Y", "S", "M", "A"}) EXPECT_TRUE(texts.contains(mark + text)) << mark;
  EXPECT_FALSE(std::filesystem::exists(trap));
}

TEST(Figure, SeveralStandInOnePage) {
  Figure figure = line({0.0, 1.0}, {0.0, 1.0});
  figure.series[0].style = SeriesStyle::open_points;
  figure.series[0].label = "s";
  const std::vector<Figure> figures(3, figure);
  const std::vector<std::string> svgs = render_svgs(figures, 7);
  ASSERT_EQ(svgs.size(), 3U);
  EXPECT_EQ(svgs[0].find("<svg "), 0U);
  std::string page = "<body>";
  for (const std::string& svg : svgs) page += svg;
  const pugi::xml_document xml = parsed(page + "</body>");
  std::set<std::string> ids;
  for (const auto& node : xml.select_nodes("//*[@id]")) {
    const std::string id = node.node().attribute("id").value();
    EXPECT_TRUE(ids.insert(id).second) << id;
  }
  EXPECT_TRUE(ids.contains("figure-9-gnuplot_plot_2"));
  std::size_t references = 0;
  for (const auto& node : xml.select_nodes("//*[@href]")) {
    EXPECT_TRUE(ids.contains(node.node().attribute("href").value() + 1));
    ++references;
  }
  EXPECT_GE(references, 6U);
}

TEST(Figure, OddDataStillMakeAFigure) {
  EXPECT_NE(render_svg(Figure{}).find("no data to show"), std::string::npos);
  EXPECT_NE(render_svg(line({kNaN}, {1.0})).find("no data to show"), std::string::npos);
  EXPECT_EQ(first_curve(line({5.0, 5.0}, {0.0, 0.0})).points.size(), 1U);
  Figure constant = line({1.0, 2.0}, {3.0, 3.0});
  constant.y.logarithmic = true;
  EXPECT_EQ(first_curve(constant).points.size(), 2U);
  EXPECT_EQ(first_curve(line({0.0, 1.0}, {-1e300, 1e300})).points.size(), 2U);
  Figure beyond = line({0.0, 1.0, 2.0}, {1.0, 1.7e308, 5e-324});
  EXPECT_EQ(first_curve(beyond).points.size(), 2U);
  beyond.y.logarithmic = true;
  beyond.markers = {{MarkerLine::Direction::horizontal, -1.0, "nowhere"}};
  const std::string svg = render_svg(beyond);
  EXPECT_EQ(svg.find("nowhere"), std::string::npos);
}

TEST(Figure, RefusesContradictions) {
  EXPECT_THROW((void)render_svg(line({0.0, 1.0}, {0.0})), std::invalid_argument);
  Figure errors = line({0.0, 1.0}, {0.0, 1.0});
  errors.series[0].y_error = {1.0};
  EXPECT_THROW((void)render_svg(errors), std::invalid_argument);
  Figure range = line({0.0}, {0.0});
  range.x.min = range.x.max = 1.0;
  EXPECT_THROW((void)render_svg(range), std::invalid_argument);
  Figure bound = line({1.0}, {1.0});
  bound.y.logarithmic = true;
  bound.y.min = 0.0;
  EXPECT_THROW((void)render_svg(bound), std::invalid_argument);
  Figure aspect = line({1.0}, {1.0});
  aspect.equal_aspect = aspect.x.logarithmic = true;
  EXPECT_THROW((void)render_svg(aspect), std::invalid_argument);
  Figure shape = line({1.0}, {1.0});
  shape.height_to_width = kNaN;
  EXPECT_THROW((void)render_svg(shape), std::invalid_argument);
}

std::string labels(const AxisScale& scale, int count) {
  std::string text;
  for (const Tick& tick : scale.ticks(count)) {
    if (!tick.label.empty()) text += (text.empty() ? "" : " ") + tick.label;
  }
  return text;
}

TEST(AxisScale, TicksAreRoundNumbers) {
  const auto linear = [](double min, double max) { return AxisScale({.min = min, .max = max}, {}); };
  EXPECT_EQ(labels(linear(0.0, 10.0), 10), "0 1 2 3 4 5 6 7 8 9 10");
  EXPECT_EQ(labels(linear(-0.3, 0.3), 3), "−0.2 0 0.2");
  EXPECT_EQ(labels(linear(0.0, 3.6e6), 4), "0 1×10^{6} 2×10^{6} 3×10^{6}");
  EXPECT_EQ(labels(linear(1.0e-5, 2.0e-5), 2), "1.0×10^{−5} 1.5×10^{−5} 2.0×10^{−5}");
  const auto logarithmic = [](double min, double max) {
    return AxisScale({.logarithmic = true, .min = min, .max = max}, {});
  };
  EXPECT_EQ(labels(logarithmic(1.0, 1000.0), 6), "1 10 100 1000");
  EXPECT_EQ(labels(logarithmic(3.0, 300.0), 9), "5 10 20 50 100 200");
  EXPECT_EQ(labels(logarithmic(1e-7, 1e-5), 3), "10^{−7} 10^{−6} 10^{−5}");
  EXPECT_EQ(labels(logarithmic(100.0, 130.0), 4), "100 110 120 130");
  EXPECT_EQ(labels(logarithmic(1.0, 1e12), 4), "1 1000 10^{6} 10^{9} 10^{12}");
}

TEST(AxisScale, RangeHoldsTheDataAndStaysAtZero) {
  const AxisScale scale({}, {0.0, 10.0, kNaN});
  EXPECT_EQ(scale.min(), 0.0);
  EXPECT_DOUBLE_EQ(scale.max(), 10.4);
  const AxisScale logarithmic({.logarithmic = true}, {-5.0, 0.0, 1.0, 100.0});
  EXPECT_DOUBLE_EQ(logarithmic.min(), std::pow(10.0, -0.08));
  EXPECT_DOUBLE_EQ(logarithmic.max(), std::pow(10.0, 2.08));
}

TEST(Gnuplot, FailureCarriesItsWords) {
  try {
    (void)run_gnuplot("plot nonsense(1)\n");
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos) << error.what();
  }
}

TEST(Gnuplot, MissingIsSaid) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string message;
  try {
    (void)run_gnuplot("plot x\n");
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("gnuplot-nox"), std::string::npos) << message;
}

}  // namespace
}  // namespace isotach::reports
