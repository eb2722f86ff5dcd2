// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "app/profile_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "app/command.hpp"
#include "datasets/input_error.hpp"
#include "images/circle_view.hpp"
#include "images/mould_picture.hpp"

namespace isotach::app {
namespace {

using datasets::FilePlace;
using datasets::InputError;
using Found = std::pair<images::View, std::string>;

constexpr double kMillimetre = 1e-3;     // m
constexpr double kGreatestLength = 1e5;  // mm
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kCircleScatter = 0.01;  // of the diameter, beyond which points are on no circle

[[noreturn]] void refuse(std::string_view option, std::string_view found, std::string_view accepted) {
  throw InputError(FilePlace{"command line"}, option, found, accepted);
}

Eigen::Vector2d place_of(std::string_view option, std::string_view text) {
  const std::vector<double> numbers = numbers_of(option, text, 2);
  return {numbers[0], numbers[1]};
}

void need(bool given, std::string_view option, std::string_view with) {
  if (!given) refuse(option, "not given", fmt::format("{} needs it", with));
}

std::optional<double> camera_distance(const ViewOptions& options) {
  if (!options.camera_distance_mm) return {};
  return kMillimetre * *options.camera_distance_mm;
}

Found by_scale(const ViewOptions& options, cv::Size size) {
  const double scale = *options.scale_mm_per_pixel;
  return {images::level_view(kMillimetre * scale, size, camera_distance(options)),
          fmt::format("{:.5g} mm a pixel, as given", scale)};
}

Found by_reference(const ViewOptions& options, cv::Size size) {
  need(options.reference_points.size() == 2, "--reference-points", "--reference-length-mm");
  const Eigen::Vector2d a = place_of("--reference-points", options.reference_points[0]);
  const Eigen::Vector2d b = place_of("--reference-points", options.reference_points[1]);
  const double pixels = (b - a).norm();
  if (!(pixels >= 1.0)) refuse("--reference-points", "two equal places", "places at least a pixel apart");
  const double scale = *options.reference_length_mm / pixels;
  return {images::level_view(kMillimetre * scale, size, camera_distance(options)),
          fmt::format("{:.5g} mm a pixel, by {:g} mm over {:.1f} pixels", scale, *options.reference_length_mm,
                      pixels)};
}

Found by_mould(const ViewOptions& options, cv::Size size, const images::Looked& looked,
               std::uintmax_t max_bytes) {
  need(options.mould_diameter_mm.has_value(), "--mould-diameter-mm", "--mould-picture");
  const images::Picture picture = images::read_picture(*options.mould_picture, max_bytes);
  if (picture.codes.size() != size) {
    throw InputError(FilePlace{picture.file}, "size of the picture",
                     fmt::format("{} by {} pixels", picture.codes.cols, picture.codes.rows),
                     fmt::format("{} by {}, as the pictures of the slump", size.width, size.height));
  }
  const auto width = images::mould_width(picture, looked);
  if (!width) throw InputError(FilePlace{picture.file}, "no mould was found: " + width.error().message);
  const double outside = *options.mould_diameter_mm + 2.0 * options.mould_wall_mm;
  const double scale = images::scale_of(*width, kMillimetre * outside, camera_distance(options));
  return {images::level_view(scale, size, camera_distance(options)),
          fmt::format(
              "{:.5g} mm a pixel, by the mould, {:g} mm wide outside (wall {:g} mm) over {:.2f} pixels, its "
              "edges straight to {:.2f} pixels, taper {:.2f} %",
              scale / kMillimetre, outside, options.mould_wall_mm, width->pixels, width->scatter,
              100.0 * width->taper)};
}

Found by_rectangle(const ViewOptions& options, cv::Size size) {
  need(!options.rectangle_size_mm.empty(), "--rectangle-size-mm", "--rectangle");
  const std::vector<double> sides = numbers_of("--rectangle-size-mm", options.rectangle_size_mm, 2);
  if (!(sides[0] > 0.0 && sides[1] > 0.0)) {
    refuse("--rectangle-size-mm", options.rectangle_size_mm, "width and height > 0");
  }
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = place_of("--rectangle", options.rectangle[i]);
  const auto view = images::rectangle_view(corners, kMillimetre * sides[0], kMillimetre * sides[1], size,
                                           camera_distance(options));
  if (!view) {
    refuse("--rectangle", fmt::format("{}", fmt::join(options.rectangle, " ")),
           "corners of a convex figure: upper left, upper right, lower right, lower left");
  }
  return {*view,
          fmt::format("by a rectangle of {:g} by {:g} mm in the plane of the axis, standing on the base",
                      sides[0], sides[1])};
}

Found by_circle(const ViewOptions& options, cv::Size size) {
  need(options.circle_diameter_mm.has_value(), "--circle-diameter-mm", "--circle-point");
  std::vector<Eigen::Vector2d> points;
  for (const std::string& text : options.circle_points) points.push_back(place_of("--circle-point", text));
  const double diameter = kMillimetre * *options.circle_diameter_mm;
  const bool on_base = options.circle_on == "base";
  if (on_base) need(options.camera_distance_mm.has_value(), "--camera-distance-mm", "--circle-on base");
  const auto found = on_base ? images::base_circle_view(points, diameter, size, *camera_distance(options))
                             : images::standing_disc_view(points, diameter, size, camera_distance(options));
  if (!found) refuse("--circle-point", fmt::format("{} points", points.size()), "5 or more on an ellipse");
  if (found->scatter > kCircleScatter * diameter) {
    refuse("--circle-point", fmt::format("points {:.2g} mm off a circle", found->scatter / kMillimetre),
           fmt::format("within {:g} mm", kCircleScatter * diameter / kMillimetre));
  }
  return {found->view,
          fmt::format("by a circle of {:g} mm {}, its points {:.2g} mm off it, {} {:.2f} degrees",
                      *options.circle_diameter_mm,
                      on_base ? "on the base about the axis" : "in the plane of the axis",
                      found->scatter / kMillimetre, on_base ? "seen from above by" : "tilted by",
                      kDegrees * found->elevation)};
}

}  // namespace

std::vector<double> numbers_of(std::string_view option, std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (true) {
    double number = 0.0;
    const auto [next, error] = std::from_chars(at, end, number);
    const bool ends_well = next == end || *next == ',';
    if (error != std::errc() || !std::isfinite(number) || !ends_well) break;
    numbers.push_back(number);
    if (next == end) {
      if (numbers.size() == count) return numbers;
      break;
    }
    at = next + 1;
  }
  refuse(option, fmt::format("\"{}\"", text), fmt::format("{} numbers between commas", count));
}

void add_view_options(CLI::App& line, ViewOptions& options) {
  const auto length = number_between(1e-3, kGreatestLength);
  const auto group = [](CLI::Option* option) { return option->group("View and scale (one way)"); };
  group(line.add_option("--scale-mm-per-pixel", options.scale_mm_per_pixel,
                        "size of a pixel in the plane of the axis"))
      ->check(number_between(1e-4, 100.0));
  group(line.add_option("--reference-length-mm", options.reference_length_mm,
                        "a known length in the plane of the axis, between --reference-points"))
      ->check(length);
  group(line.add_option("--reference-points", options.reference_points, "its ends: column,row column,row"))
      ->expected(2);
  group(line.add_option("--mould-picture", options.mould_picture,
                        "a picture of the mould before it was raised, by the same camera"));
  group(line.add_option("--mould-diameter-mm", options.mould_diameter_mm,
                        "of the mould inside: scale by --mould-picture, volume by --fill-height-mm"))
      ->check(length);
  group(
      line.add_option("--mould-wall-mm", options.mould_wall_mm, "thickness of its wall, for --mould-picture"))
      ->check(number_between(0.0, 1000.0))
      ->capture_default_str();
  group(line.add_option(
            "--rectangle", options.rectangle,
            "corners, column,row each, of a rectangle in the plane of the axis that stands on the base: "
            "upper left, upper right, lower right, lower left"))
      ->expected(4);
  group(line.add_option("--rectangle-size-mm", options.rectangle_size_mm, "its width,height"));
  group(line.add_option("--circle-point", options.circle_points,
                        "column,row of a point on a circle; five or more, each with this option"))
      ->expected(1)
      ->take_all();
  group(line.add_option("--circle-diameter-mm", options.circle_diameter_mm, "its diameter"))->check(length);
  group(line.add_option("--circle-on", options.circle_on,
                        "where it is: on the base about the axis, or a disc in the plane of the axis"))
      ->check(CLI::IsMember({"base", "plane"}))
      ->capture_default_str();
  group(line.add_option(
            "--camera-distance-mm", options.camera_distance_mm,
            "from the plane of the axis to the lens; puts right what perspective does to radii and tops"))
      ->check(length);
}

std::pair<images::View, std::string> view_of(const ViewOptions& options, cv::Size size,
                                             const images::Looked& looked, std::uintmax_t max_bytes) {
  const int ways = (options.scale_mm_per_pixel ? 1 : 0) + (options.reference_length_mm ? 1 : 0) +
                   (options.mould_picture ? 1 : 0) + (options.rectangle.empty() ? 0 : 1) +
                   (options.circle_points.empty() ? 0 : 1);
  if (ways != 1) {
    refuse(
        "the scale", fmt::format("{} of the ways to it", ways),
        "one of --scale-mm-per-pixel, --reference-length-mm, --mould-picture, --rectangle, --circle-point");
  }
  if (options.scale_mm_per_pixel) return by_scale(options, size);
  if (options.reference_length_mm) return by_reference(options, size);
  if (options.mould_picture) return by_mould(options, size, looked, max_bytes);
  if (!options.rectangle.empty()) return by_rectangle(options, size);
  return by_circle(options, size);
}

}  // namespace isotach::app
