// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A picture with what was found in it drawn over it, to be checked by eye.
#pragma once

#include <vector>

#include "images/marks.hpp"
#include "images/picture.hpp"

namespace isotach::images {

/// An encoded picture and its size in pixels.
struct EncodedPicture {
  std::vector<unsigned char> bytes;
  int width;
  int height;
};

/// As a PNG file in full size: the edge as a line, orange left and blue right of the axis, the base line
/// green, the line above which was looked magenta where it is another, the axis white.
[[nodiscard]] EncodedPicture overlay_png(const Picture& picture, const Marks& marks);

/// The same as a JPEG file, made smaller where it is wider than `most_columns`.
[[nodiscard]] EncodedPicture overlay_jpeg(const Picture& picture, const Marks& marks, int most_columns);

}  // namespace isotach::images
