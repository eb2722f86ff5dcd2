// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mud whose water content varies over the height of the fill.
#pragma once

namespace isotach::mpm {

/// e = e0 + g (z/H - 1/2); g = 0: the same everywhere.
struct Layering {
  double mean_void_ratio;   ///< e0 (-)
  double gradient;          ///< g (-); e0 > |g|/2
  double height;            ///< H (m)
  double specific_gravity;  ///< G_s (-)

  /// e at z (m); goes on as it is outside of the fill.
  [[nodiscard]] double void_ratio(double z) const { return mean_void_ratio + gradient * (z / height - 0.5); }
  /// Of the mixture at z (kg/m3).
  [[nodiscard]] double density(double z) const;
  /// Weight of what lies above z (Pa); negative above the fill.
  [[nodiscard]] double overburden(double z) const;
};

}  // namespace isotach::mpm
