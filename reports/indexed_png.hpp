// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Pictures of few colours as PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reports/figure.hpp"

namespace isotach::reports {

/// Pixels by their place in a palette, row by row from the top; 0 is clear, k the palette's colour k - 1.
struct IndexedImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> pixels{};
};

/// The bytes of a PNG file with a palette (libpng). Throws std::invalid_argument where the picture is empty,
/// has not width times height pixels or more than 255 colours, or a pixel is not in the palette.
[[nodiscard]] std::vector<unsigned char> png_bytes(const IndexedImage& image, std::span<const Rgb> palette);

/// The same as the URI of an inline picture.
[[nodiscard]] std::string png_uri(const IndexedImage& image, std::span<const Rgb> palette);

}  // namespace isotach::reports
