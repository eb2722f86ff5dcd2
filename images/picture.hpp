// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A photograph as it stands in its file, and as the light that made it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace isotach::images {

/// Places in a picture are (column, row) in pixels of the whole picture, the middle of the upper left pixel
/// at (0, 0), columns to the right, rows downwards.
struct Picture {
  std::filesystem::path file;
  cv::Mat3b codes;  ///< 8 bits a channel, blue, green, red; upright where the file says how it was held
};

/// A rectangle of whole pixels.
struct PixelArea {
  int column = 0;  ///< of its left side
  int row = 0;     ///< of its upper side
  int width = 0;
  int height = 0;
};

/// What of a picture is looked at.
struct Looked {
  std::optional<PixelArea> region{};  ///< nothing outside of it is; by default the whole picture
  std::vector<PixelArea> ignored{};   ///< taken for background
};

/// Reads PNG, JPEG, TIFF, BMP and what else OpenCV reads. InputError: missing, a folder, larger than
/// `max_bytes`, not a picture (a video among them, with a word on frames), smaller than 64 by 64 pixels.
[[nodiscard]] Picture read_picture(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// The light at each pixel, 0 to 1, by the curve of sRGB (IEC 61966-2-1), as cameras write JPEG and PNG: blur
/// mixes light, not codes, so that only in light the middle of a blurred edge lies where the sharp one was.
[[nodiscard]] cv::Mat3f light_of(const cv::Mat3b& codes);

/// The region, or the whole picture. InputError where an area leaves the picture, or the region is smaller
/// than 64 by 64 pixels.
[[nodiscard]] PixelArea looked_area(const Picture& picture, const Looked& looked);

}  // namespace isotach::images
