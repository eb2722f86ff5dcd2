// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// From a picture of a slump to its outline.
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "images/halves.hpp"
#include "images/marks.hpp"
#include "images/picture.hpp"
#include "images/refusal.hpp"
#include "images/view.hpp"
#include "mpm/outline.hpp"

namespace isotach::images {

/// How pictures of one slump, all by a camera that stands still, are read.
struct ProfileOptions {
  Looked looked{};
  std::optional<double> base_row{};      ///< the base line is this row of the picture
  std::optional<double> axis_column{};   ///< the axis stands on the base line at this column
  std::optional<double> mould_volume{};  ///< of the mud that was filled in (m3)
  double volume_limit = 0.05;  ///< error of the volume, as a share, beyond which a picture is refused
  double spacing = 1e-3;       ///< of the points of an outline (m), about
};

/// One outline with what tells how far to trust it.
struct Reading {
  mpm::Outline outline;                ///< mean of left and right, from the toe (z = 0) to the axis; time 0
  std::vector<MeanPoint> points;       ///< the same with both sides
  double volume;                       ///< of the body of revolution (m3)
  std::optional<double> volume_error;  ///< over that of the mould, less 1
  double asymmetry;                    ///< root mean square of the half differences (m)
  double lean;                         ///< of the body to the right, from the normal of the base (rad)
  double base_tilt;                    ///< of the base line in the picture, to the right and down (rad)
  double hidden;                       ///< height above the base below which the outline is extrapolated (m)
  double pixel;                        ///< its size at the foot of the axis (m)
  double blur;                         ///< standard deviation of the edge's blur (m)
  double contrast;                     ///< of mud and background, over the background's light
  std::vector<std::string> warnings;
};

/// The outcome of one picture.
struct PictureOutcome {
  tl::expected<Reading, Refusal> reading;
  Marks marks;
};

/// Reads the outline of the mud in `picture`, whose meridian plane `view` shows. Where the view does not know
/// the base, it is `base_row`, else the edge between background and base beside the mud, else, where no base
/// stands out, the lower edge of the mud. What a known camera place does to radii is put right.
[[nodiscard]] PictureOutcome read_profile(const Picture& picture, const View& view,
                                          const ProfileOptions& options);

}  // namespace isotach::images
