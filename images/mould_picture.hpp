// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The scale by the mould itself, in a picture taken before it was raised.
#pragma once

#include <optional>
#include <tl/expected.hpp>

#include "images/picture.hpp"
#include "images/refusal.hpp"

namespace isotach::images {

/// The mould as a picture shows it.
struct MouldWidth {
  double pixels;   ///< its width across its axis, the mean over the middle three fifths of its height
  double scatter;  ///< of the widths there about a straight line, root mean square (pixels)
  double taper;    ///< change of width over the height, by its width: not 0 seen from a tilted camera
};

/// Finds the mould as find_body finds the mud, and measures its width between its edges. Refused as a
/// picture of mud is.
[[nodiscard]] tl::expected<MouldWidth, Refusal> mould_width(const Picture& picture, const Looked& looked);

/// Metres a pixel where the mould, of `diameter` (m) outside, is `pixels` wide. A camera `distance` away sees
/// it wider by 1/sqrt(1 - (R/distance)^2).
[[nodiscard]] double scale_of(const MouldWidth& width, double diameter, std::optional<double> distance);

}  // namespace isotach::images
