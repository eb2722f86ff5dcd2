// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How isotach profile learns the view and the scale from its options.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "images/picture.hpp"
#include "images/view.hpp"

namespace CLI {
class App;
}

namespace isotach::app {

/// As typed; places are "column,row" in pixels.
struct ViewOptions {
  std::optional<double> scale_mm_per_pixel{};
  std::optional<double> reference_length_mm{};
  std::vector<std::string> reference_points{};
  std::optional<std::filesystem::path> mould_picture{};
  std::optional<double> mould_diameter_mm{};  ///< inside; sets the volume too
  double mould_wall_mm = 0.0;
  std::vector<std::string> rectangle{};
  std::string rectangle_size_mm{};
  std::vector<std::string> circle_points{};
  std::optional<double> circle_diameter_mm{};
  std::string circle_on = "base";
  std::optional<double> camera_distance_mm{};
};

void add_view_options(CLI::App& line, ViewOptions& options);

/// `count` numbers between commas. InputError naming `option` where `text` is anything else.
[[nodiscard]] std::vector<double> numbers_of(std::string_view option, std::string_view text,
                                             std::size_t count);

/// The view in pictures of `size`, and how it was found, in words. InputError: none or more than one way to
/// find it, an option without those that it needs, geometry that cannot be.
[[nodiscard]] std::pair<images::View, std::string> view_of(const ViewOptions& options, cv::Size size,
                                                           const images::Looked& looked,
                                                           std::uintmax_t max_bytes);

}  // namespace isotach::app
