// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What was found in a picture, to be drawn over it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>

#include "images/base_line.hpp"
#include "images/polyline.hpp"

namespace isotach::images {

/// In pixels of the whole picture; what was not found is empty.
struct Marks {
  Polyline edge{};                                                    ///< from the left to the right foot
  std::optional<LevelLine> base{};                                    ///< the base line
  std::optional<LevelLine> cut{};                                     ///< what lies lower was not looked at
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> axis{};  ///< from the base to the top
};

}  // namespace isotach::images
