// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/indexed_png.hpp"

#include <png.h>

#include <algorithm>
#include <stdexcept>

#include "reports/base64.hpp"

namespace isotach::reports {

std::vector<unsigned char> png_bytes(const IndexedImage& image, std::span<const Rgb> palette) {
  const bool whole = image.width > 0 && image.height > 0 && image.pixels.size() == image.width * image.height;
  const bool known = std::all_of(image.pixels.begin(), image.pixels.end(),
                                 [&](std::uint8_t pixel) { return pixel <= palette.size(); });
  if (!whole || !known || palette.size() > 255) throw std::invalid_argument("not a picture of this palette");

  std::vector<png_byte> colours{0, 0, 0, 0};  // the clear one
  for (const Rgb& colour : palette) {
    colours.insert(colours.end(), {colour.red, colour.green, colour.blue, 255});
  }
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGBA_COLORMAP;
  header.colormap_entries = static_cast<png_uint_32>(palette.size() + 1);
  // once for the size, once for the bytes
  png_alloc_size_t size = 0;
  const auto write = [&](void* memory) {
    return png_image_write_to_memory(&header, memory, &size, 0, image.pixels.data(), 0, colours.data()) != 0;
  };
  std::vector<unsigned char> bytes;
  bool written = write(nullptr);
  if (written) {
    bytes.resize(size);
    written = write(bytes.data());
  }
  if (!written) throw std::runtime_error(std::string("libpng: ") + header.message);
  return bytes;
}

std::string png_uri(const IndexedImage& image, std::span<const Rgb> palette) {
  return "data:image/png;base64," + base64(png_bytes(image, palette));
}

}  // namespace isotach::reports
