// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "datasets/input_error.hpp"

namespace isotach::images {
namespace {

using datasets::FilePlace;
using datasets::InputError;

constexpr int kLeastSide = 64;  // pixels
constexpr const char* kAccepted =
    "a picture (PNG, JPEG, TIFF, BMP); frames of a video are made by: ffmpeg -i VIDEO -vf fps=5 "
    "frame_%04d.png";

std::vector<unsigned char> bytes_of(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(FilePlace{file}, "no such file");
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(FilePlace{file}, "the file", "a folder", kAccepted);
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(FilePlace{file}, "cannot be read: " + error.message());
  if (size > max_bytes) {
    throw InputError(FilePlace{file}, "the file", fmt::format("{} bytes", size),
                     fmt::format("at most {} (see --max-file-mb)", max_bytes));
  }
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw InputError(FilePlace{file}, "cannot be read");
  }
  return bytes;
}

void check_inside(const Picture& picture, const PixelArea& area, const char* option) {
  const bool inside = area.column >= 0 && area.row >= 0 && area.width > 0 && area.height > 0 &&
                      area.column <= picture.codes.cols - area.width &&
                      area.row <= picture.codes.rows - area.height;
  if (inside) return;
  throw InputError(
      FilePlace{picture.file}, option,
      fmt::format("column {}, row {}, {} by {} pixels", area.column, area.row, area.width, area.height),
      fmt::format("an area within the picture's {} by {}", picture.codes.cols, picture.codes.rows));
}

}  // namespace

Picture read_picture(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  const std::vector<unsigned char> bytes = bytes_of(file, max_bytes);
  cv::Mat codes;
  if (!bytes.empty()) {
    try {
      codes = cv::imdecode(bytes, cv::IMREAD_COLOR);
    } catch (const cv::Exception& error) {
      throw InputError(FilePlace{file}, "the file", error.err, kAccepted);
    }
  }
  if (codes.empty()) throw InputError(FilePlace{file}, "the file", "no picture that can be read", kAccepted);
  if (codes.cols < kLeastSide || codes.rows < kLeastSide) {
    throw InputError(FilePlace{file}, "the picture", fmt::format("{} by {} pixels", codes.cols, codes.rows),
                     fmt::format("at least {0} by {0}", kLeastSide));
  }
  return {file, codes};
}

cv::Mat3f light_of(const cv::Mat3b& codes) {
  cv::Mat1f table(1, 256);
  for (int code = 0; code < 256; ++code) {
    const double c = code / 255.0;
    table(0, code) = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  cv::Mat3f light;
  cv::LUT(codes, table, light);
  return light;
}

PixelArea looked_area(const Picture& picture, const Looked& looked) {
  for (const PixelArea& area : looked.ignored) check_inside(picture, area, "--ignore");
  const PixelArea region = looked.region.value_or(PixelArea{0, 0, picture.codes.cols, picture.codes.rows});
  check_inside(picture, region, "--region");
  if (region.width < kLeastSide || region.height < kLeastSide) {
    throw InputError(FilePlace{picture.file}, "--region",
                     fmt::format("{} by {} pixels", region.width, region.height),
                     fmt::format("at least {0} by {0}", kLeastSide));
  }
  return region;
}

}  // namespace isotach::images
