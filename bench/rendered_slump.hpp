// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Pictures of slumps whose outline is known: rendered, with what spoils a photograph.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mpm/outline.hpp"

namespace isotach::rendered {

using Outline = std::vector<mpm::OutlinePoint>;  // from the toe to the axis (m)

/// A cap z = height (1 - (r/radius)^power): power 2 a parabola, more a flat top and a steep foot.
[[nodiscard]] Outline cap(double radius, double height, double power = 2.0);
/// What is left of a cylinder under a mould just raised: a foot of `radius` that narrows to `neck` at a third
/// of the height, straight up from there, and a flat top with an edge.
[[nodiscard]] Outline collar(double radius, double neck, double height);

/// A pinhole that looks at the meridian plane; without one lines of sight are parallel and level.
struct Pinhole {
  double distance = 1.0;  ///< from the axis (m)
  double height = 0.0;    ///< above the base (m)
  double pitch = 0.0;     ///< downwards (rad)
  double yaw = 0.0;       ///< to the right (rad)
};

/// What is photographed and how. Lights are linear, 1 the whitest.
struct Scene {
  Outline outline;
  std::optional<Outline> left{};  ///< of the left half, where it is another
  bool mud = true;
  double pixel = 0.2e-3;  ///< m a pixel in the meridian plane, for a pinhole at the middle of the picture
  int width = 1200;
  int height = 560;
  double axis_column = 600.3;  ///< where the axis stands on the base; of parallel views only
  double base_row = 470.6;     ///< of parallel views only
  double roll = 0.0;           ///< of the camera: the picture's base line falls to the right (rad)
  std::optional<Pinhole> pinhole{};
  double mud_light = 0.15;
  double background_light = 0.6;
  double base_light = 0.3;
  bool base = true;          ///< false: the base looks like the background
  double base_behind = 0.0;  ///< of a pinhole: from the axis to the base's far edge (m)
  double uneven = 0.0;       ///< light falls by this share from the upper left to the lower right
  double shadow = 0.0;       ///< share of light that the mud's soft shadow on the background takes
  double grains = 0.0;       ///< relative contrast of the base's grains, a fraction of a millimetre wide
  double blur = 0.6;         ///< pixels, standard deviation
  double noise = 0.0;        ///< codes of 8 bits, standard deviation
  std::uint64_t seed = 1;
};

/// The picture, 8 bits a channel by the curve of sRGB.
[[nodiscard]] cv::Mat3b render(const Scene& scene);

/// Pixel of a place of the meridian plane (x, z from the axis and the base).
[[nodiscard]] Eigen::Vector2d pixel_of(const Scene& scene, const Eigen::Vector2d& place);
/// Pixel of a place anywhere: x to the right, z up, y towards the camera.
[[nodiscard]] Eigen::Vector2d pixel_of(const Scene& scene, const Eigen::Vector3d& place);

}  // namespace isotach::rendered
