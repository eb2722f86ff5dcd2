// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The edge of what stands on the base of a picture: mud, or the mould.
#pragma once

#include <optional>
#include <tl/expected.hpp>

#include "images/edge.hpp"
#include "images/marks.hpp"
#include "images/picture.hpp"
#include "images/refusal.hpp"

namespace isotach::images {

/// A body with its edge, places in pixels of the whole picture.
struct Body {
  Edge edge;        ///< from the left foot over the top to the right foot
  LevelLine base;   ///< on which it stands
  LevelLine cut;    ///< what lies lower than this was not looked at: the base line, or what hides it
  double contrast;  ///< with the background, over the background's light
};

struct BodyOutcome {
  tl::expected<Body, Refusal> body;
  Marks marks;  ///< as far as it came
};

/// Finds the body. `base`, where it is known, is the base line; else the line where the background ends
/// beside the body is, else the body's lower edge. Where the background ends above a known base line, as
/// before a camera that looks down on the base, the edge is followed down to there. Refused, besides what
/// find_silhouette refuses: no base line; an edge of which more than a quarter is unclear.
[[nodiscard]] BodyOutcome find_body(const Picture& picture, const Looked& looked,
                                    const std::optional<LevelLine>& base);

}  // namespace isotach::images
