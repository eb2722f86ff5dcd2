// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Pictures of fields: colours, rasters read back with libpng, and how figure and animation are put together.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <pugixml.hpp>
#include <stdexcept>

#include "reports/field_animation.hpp"
#include "reports/field_csv.hpp"
#include "reports/field_figure.hpp"
#include "reports/indexed_png.hpp"
#include "reports_base64.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

constexpr float kEmpty = std::numeric_limits<float>::quiet_NaN();

/// A PNG file as RGBA rows from the top.
struct Decoded {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<unsigned char> rgba{};

  [[nodiscard]] std::array<int, 4> at(std::size_t x, std::size_t y) const {
    const std::size_t i = 4 * (y * width + x);
    return {rgba[i], rgba[i + 1], rgba[i + 2], rgba[i + 3]};
  }
};

Decoded decoded(const std::vector<unsigned char>& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
  image.format = PNG_FORMAT_RGBA;
  Decoded result{image.width, image.height, std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
  EXPECT_NE(png_image_finish_read(&image, nullptr, result.rgba.data(), 0, nullptr), 0) << image.message;
  return result;
}

Decoded decoded(const pugi::xml_node& image) {
  constexpr std::string_view kHead = "data:image/png;base64,";
  const std::string uri = image.attribute("href").value();
  EXPECT_TRUE(uri.starts_with(kHead));
  return decoded(from_base64(uri.substr(kHead.size())));
}

std::array<int, 4> opaque(const Rgb& colour) {
  return {colour.red, colour.green, colour.blue, 255};
}

pugi::xml_document parsed(const Drawing& drawing) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(drawing.svg.c_str()));
  return document;
}

/// A block of 3 by 2 cells of 10 mm, one of them empty, in a mould of radius 30 mm.
mpm::Frame small_frame(double time, double rim) {
  mpm::Frame frame;
  frame.time = time;
  frame.rim = rim;
  frame.fields = {0.01, 3, 2, {1e-3F, 1e-2F, 1e-1F, 1.0F, 1e-3F, kEmpty}, {}, {}};
  frame.fields.overconsolidation_ratio = {1.0F, 1.1F, 1.2F, 1.3F, 1.4F, kEmpty};
  frame.fields.pore_pressure = {0.0F, 100.0F, 200.0F, 300.0F, 400.0F, kEmpty};
  frame.outline = {time, {{0.03, 0.0}, {0.03, 0.01}, {0.0, 0.02}}};
  return frame;
}

mpm::Mould small_mould() {
  mpm::Mould mould;
  mould.diameter = 0.06;
  mould.fill_height = 0.02;
  return mould;
}

// Colours of the original (colormaps.py of github.com/BIDS/colormap) times 255, none at a place of the table.
TEST(Viridis, IsTheOriginalToWithinFive) {
  constexpr std::array<std::pair<int, std::array<int, 3>>, 5> kOriginal{{{7, {70, 11, 94}},
                                                                         {64, {59, 82, 139}},
                                                                         {128, {33, 145, 140}},
                                                                         {200, {112, 207, 87}},
                                                                         {247, {234, 229, 26}}}};
  for (const auto& [index, original] : kOriginal) {
    const Rgb colour = viridis(index / 255.0);
    EXPECT_NEAR(colour.red, original[0], 5) << index;
    EXPECT_NEAR(colour.green, original[1], 5) << index;
    EXPECT_NEAR(colour.blue, original[2], 5) << index;
  }
  EXPECT_EQ(hex(viridis(0.0)), "#440154");
  EXPECT_EQ(hex(viridis(-1.0)), "#440154");
  EXPECT_EQ(hex(viridis(1.0)), "#fde725");
  EXPECT_EQ(hex(viridis(2.0)), "#fde725");
}

// Read in grey, a greater value is still lighter (luma of ITU-R BT.601).
TEST(Viridis, GrowsLighter) {
  double last = 0.0;
  for (const Rgb& colour : ColourScale::palette()) {
    const double luma = 0.299 * colour.red + 0.587 * colour.green + 0.114 * colour.blue;
    EXPECT_GT(luma, last);
    last = luma;
  }
}

TEST(ColourScale, LevelsAreEqualPartsBetweenTheLimits) {
  const ColourScale linear({.min = 0.0, .max = 64.0});
  EXPECT_EQ(linear.level(0.5), 1);
  EXPECT_EQ(linear.level(31.5), 32);
  EXPECT_EQ(linear.level(63.5), 64);
  EXPECT_EQ(linear.level(-5.0), 1);
  EXPECT_EQ(linear.level(500.0), 64);
  EXPECT_EQ(linear.level(std::nan("")), 0);
  const ColourScale decades({.logarithmic = true, .min = 1e-4, .max = 1.0});
  EXPECT_EQ(decades.level(1.01e-4), 1);
  EXPECT_EQ(decades.level(1.01e-2), 33);
  EXPECT_EQ(decades.level(0.99), 64);
  EXPECT_EQ(decades.level(0.0), 1);
}

TEST(ColourScale, LimitsAreRoundAndLeaveOutliersOut) {
  std::vector<float> values(1000, 0.02F);
  values[3] = 7.0F;  // one in a thousand
  for (std::size_t i = 100; i < 200; ++i) values[i] = 0.3F;
  values.push_back(-1.0F);
  values.push_back(kEmpty);
  const Axis decades = logarithmic_limits("x", values);
  EXPECT_TRUE(decades.logarithmic);
  EXPECT_DOUBLE_EQ(decades.min.value(), 1e-2);
  EXPECT_DOUBLE_EQ(decades.max.value(), 1.0);
  std::vector<float> ratios;
  for (int i = 0; i <= 1000; ++i) ratios.push_back(1.02F + 0.00038F * static_cast<float>(i));
  ratios.push_back(1500.0F);
  const Axis linear = linear_limits("x", ratios);
  EXPECT_FALSE(linear.logarithmic);
  EXPECT_NEAR(linear.min.value(), 1.0, 1e-12);
  EXPECT_NEAR(linear.max.value(), 1.4, 1e-12);  // the 95th percentile is 1.381, steps are 0.1
}

TEST(ColourScale, LimitsOfEqualValuesOrNoneStillDiffer) {
  for (const auto& values :
       {std::vector<float>{}, std::vector<float>(5, 1.5F), std::vector<float>(5, 0.0F)}) {
    const Axis linear = linear_limits("x", values);
    EXPECT_LT(linear.min.value(), linear.max.value());
    const Axis decades = logarithmic_limits("x", values);
    EXPECT_LE(100.0 * decades.min.value(), decades.max.value() * (1.0 + 1e-12));
  }
  EXPECT_DOUBLE_EQ(linear_limits("x", {1.5F, 1.5F}).min.value(), 1.5);
}

TEST(IndexedPng, DecodesToItsSizeAndColours) {
  const std::vector<Rgb> palette{{255, 0, 0}, {1, 2, 3}};
  const Decoded png = decoded(png_bytes({3, 2, {0, 1, 2, 2, 1, 0}}, palette));
  ASSERT_EQ(png.width, 3U);
  ASSERT_EQ(png.height, 2U);
  EXPECT_EQ(png.at(0, 0)[3], 0) << "clear";
  EXPECT_EQ(png.at(1, 0), opaque(palette[0]));
  EXPECT_EQ(png.at(2, 0), opaque(palette[1]));
  EXPECT_EQ(png.at(0, 1), opaque(palette[1]));
  EXPECT_EQ(png.at(1, 1), opaque(palette[0]));
  EXPECT_EQ(png.at(2, 1)[3], 0);
}

TEST(IndexedPng, RefusesWhatIsNoPictureOfThePalette) {
  const std::vector<Rgb> palette{{255, 0, 0}};
  EXPECT_THROW((void)png_bytes({3, 2, {0, 1}}, palette), std::invalid_argument);
  EXPECT_THROW((void)png_bytes({0, 0, {}}, palette), std::invalid_argument);
  EXPECT_THROW((void)png_bytes({1, 1, {2}}, palette), std::invalid_argument);
  EXPECT_THROW((void)png_bytes({1, 1, {0}}, std::vector<Rgb>(256, palette[0])), std::invalid_argument);
}

TEST(FieldFigure, ShowsTheCellsInTheirColoursAndPlaces) {
  const std::vector<mpm::Frame> frames{small_frame(0.5, 0.03)};
  const pugi::xml_document svg = parsed(field_figure(FieldQuantity::strain_rate_norm, frames, small_mould()));
  const pugi::xml_node panel = svg.child("svg").child("g");
  EXPECT_STREQ(panel.attribute("class").value(), "panel");
  EXPECT_STREQ(panel.child("text").child_value(), "0.5 s");
  const pugi::xml_node image = panel.child("image");
  EXPECT_NE(std::string_view(image.attribute("style").value()).find("pixelated"), std::string_view::npos);
  // 30 by 20 mm; the corner at axis and base is where the frame's lower left corner is
  const double width = image.attribute("width").as_double();
  EXPECT_NEAR(image.attribute("height").as_double() / width, 2.0 / 3.0, 2e-3);
  const pugi::xml_node box = panel.child("g").child("rect");
  EXPECT_NEAR(image.attribute("x").as_double(), box.attribute("x").as_double(), 0.11);
  EXPECT_NEAR(image.attribute("y").as_double() + image.attribute("height").as_double(),
              box.attribute("y").as_double() + box.attribute("height").as_double(), 0.21);

  const Decoded png = decoded(image);
  ASSERT_EQ(png.width, 3U);
  ASSERT_EQ(png.height, 2U);
  // limits are whole decades, 1e-3 and 1: the lower row, from 1e-3 to 0.1, is the second one of the picture
  const auto palette = ColourScale::palette();
  EXPECT_EQ(png.at(0, 1), opaque(palette[0]));
  EXPECT_EQ(png.at(1, 1), opaque(palette[21]));  // a third of 64
  EXPECT_EQ(png.at(2, 1), opaque(palette[42]));
  EXPECT_EQ(png.at(0, 0), opaque(palette[63]));
  EXPECT_EQ(png.at(1, 0), opaque(palette[0]));
  EXPECT_EQ(png.at(2, 0)[3], 0);
}

TEST(FieldFigure, HasAPanelForEachFrameAndTheMouldWhereItStillIs) {
  const std::vector<mpm::Frame> frames{small_frame(0.1, 0.005), small_frame(0.2, 0.5), small_frame(0.3, 0.5),
                                       small_frame(0.4, 0.5)};
  const Drawing drawing = field_figure(FieldQuantity::overconsolidation_ratio, frames, small_mould());
  const pugi::xml_document svg = parsed(drawing);
  EXPECT_EQ(svg.select_nodes("//g[@class='panel']").size(), 4U);
  EXPECT_EQ(svg.select_nodes("//path[@class='outline']").size(), 4U);
  EXPECT_EQ(svg.select_nodes("//image").size(), 5U) << "and the colour bar";
  ASSERT_EQ(svg.select_nodes("//line[@class='wall']").size(), 1U);
  const pugi::xml_node first = svg.child("svg").child("g");
  EXPECT_TRUE(first.find_child_by_attribute("line", "class", "wall"));
  EXPECT_EQ(svg.select_nodes("//*[@id]").size(), 0U);
  EXPECT_NE(drawing.svg.find("overconsolidation ratio OCR (-)"), std::string::npos);
  EXPECT_NE(drawing.caption.find("linear from 1.0 to 1.4;"), std::string::npos) << drawing.caption;
  EXPECT_THROW((void)field_figure(FieldQuantity::strain_rate_norm, {}, small_mould()), std::invalid_argument);
}

TEST(FieldAnimation, ShowsEachFrameInItsTurn) {
  std::vector<mpm::Frame> frames;
  for (const double time : mpm::frame_times(30.0, 15)) frames.push_back(small_frame(time, 0.06 * time));
  const Drawing drawing = field_animation(FieldQuantity::strain_rate_norm, frames, small_mould());
  const pugi::xml_document svg = parsed(drawing);
  const pugi::xpath_node_set groups = svg.select_nodes("/svg/g/g[@class='frame']");
  ASSERT_EQ(groups.size(), 15U);
  double last_end = 0.0;
  double last_bar = -1.0;
  for (const pugi::xpath_node& found : groups) {
    const pugi::xml_node group = found.node();
    const bool last = last_end > 0.85;
    EXPECT_STREQ(group.attribute("visibility").value(), last ? "visible" : "hidden");
    const pugi::xml_node animate = group.child("animate");
    EXPECT_STREQ(animate.attribute("dur").value(), "8s");
    EXPECT_STREQ(animate.attribute("repeatCount").value(), "indefinite");
    EXPECT_STREQ(animate.attribute("calcMode").value(), "discrete");
    const std::string values = animate.attribute("values").value();
    std::string times = animate.attribute("keyTimes").value();
    const bool first = last_bar < 0.0;
    EXPECT_EQ(values, first ? "visible;hidden" : last ? "hidden;visible" : "hidden;visible;hidden");
    ASSERT_TRUE(times.starts_with(first ? "0" : "0;"));
    times = times.substr(2);
    if (!first) {
      EXPECT_NEAR(std::stod(times), last_end, 1e-9) << "no gap, no overlap";
      times = last ? "1" : times.substr(times.find(';') + 1);
    }
    last_end = std::stod(times);
    const double bar = group.child("rect").attribute("width").as_double();
    EXPECT_GT(bar, last_bar);
    last_bar = bar;
    EXPECT_TRUE(group.child("image"));
    EXPECT_TRUE(group.child("path"));
  }
  EXPECT_EQ(last_end, 1.0);
  EXPECT_NE(drawing.svg.find("@media print{.frame{visibility:hidden!important}"), std::string::npos);
  // the rim passes the top of the drawing, 20.8 mm, before 0.35 s
  EXPECT_LT(svg.select_nodes("//line[@class='wall']").size(), 7U);
  EXPECT_GE(svg.select_nodes("//line[@class='wall']").size(), 3U);
  EXPECT_EQ(svg.select_nodes("//script").size(), 0U);
  EXPECT_EQ(svg.select_nodes("//*[@id]").size(), 0U);
  EXPECT_THROW((void)field_animation(FieldQuantity::strain_rate_norm, {}, small_mould()),
               std::invalid_argument);
}

TEST(FieldAnimation, OfOneFrameIsAPicture) {
  const std::vector<mpm::Frame> frames{small_frame(1.0, 0.06)};
  const pugi::xml_document svg =
      parsed(field_animation(FieldQuantity::strain_rate_norm, frames, small_mould()));
  EXPECT_STREQ(svg.select_node("/svg/g/g[@class='frame']").node().attribute("visibility").value(), "visible");
}

// Waves through all of the largest map, and an outline as long as that of a slump.
TEST(FieldAnimation, SixtyFramesOfTheLargestMapFitIntoTwoMegabytes) {
  constexpr std::size_t kSide = mpm::kLargestMap;
  std::vector<mpm::Frame> frames;
  for (const double time : mpm::frame_times(30.0, 60)) {
    mpm::Frame frame;
    frame.time = time;
    frame.rim = 0.06 * time;
    frame.fields = {0.0005, kSide, kSide, {}, {}, {}};
    for (std::size_t cell = 0; cell < kSide * kSide; ++cell) {
      const double x = static_cast<double>(cell % kSide) / kSide;
      const double y = static_cast<double>(cell / kSide) / kSide;
      const double decades = 2.0 * std::sin(9.0 * x + time) * std::cos(7.0 * y - time) - 2.0;
      frame.fields.strain_rate_norm.push_back(static_cast<float>(std::pow(10.0, decades)));
    }
    for (std::size_t i = 0; i <= 4 * kSide; ++i) {
      const double turn = 0.5 * std::numbers::pi * static_cast<double>(i) / (4 * kSide);
      frame.outline.points.push_back({0.1 * std::cos(turn), 0.1 * std::sin(turn)});
    }
    frames.push_back(std::move(frame));
  }
  const Drawing drawing = field_animation(FieldQuantity::strain_rate_norm, frames, small_mould());
  EXPECT_LT(drawing.svg.size(), 2'000'000U);
  EXPECT_GT(drawing.svg.size(), 100'000U);
}

class FieldCsv : public ResultFolder {};

TEST_F(FieldCsv, HasARowForEachCellThatIsNotEmpty) {
  OutputDirectory output(root_ / "out");
  write_fields(output, {small_frame(0.5, 0.0)});
  output.commit();
  std::ifstream file(root_ / "out/fields.csv");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_TRUE(text.starts_with("time_s,r_mm,z_mm,strain_rate_per_s,ocr,pore_pressure_kPa\n0.5,5,5,")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 5);
  EXPECT_NE(text.find("\n0.5,5,15,1,"), std::string::npos) << text;
}

}  // namespace
}  // namespace isotach::reports
