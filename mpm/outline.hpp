// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The outline of the mud, traced from the toe over the surface to the axis.
#pragma once

#include <vector>

namespace isotach::mpm {

struct Particles;

/// A point of the meridian plane (m).
struct OutlinePoint {
  double r;
  double z;
};

/// The free surface at one time.
struct Outline {
  double time;                       ///< s
  std::vector<OutlinePoint> points;  ///< ordered from the toe (z = 0) to the axis (r = 0)

  template <class Archive>
  void visit(Archive& archive) {
    archive(time);
    archive(points);
  }

  /// Height of the highest point (m).
  [[nodiscard]] double height() const;
  /// Largest radius (m).
  [[nodiscard]] double toe() const;
  /// Volume inside (m3), of the full body of revolution.
  [[nodiscard]] double volume() const;
};

/// The contour where the volume fraction of mud, averaged over about a cell, is one half. The average is
/// mirrored in base and axis, so that a surface meeting them at a right angle is found where it is.
[[nodiscard]] Outline trace_outline(const Particles& particles, double cell_size, double time);

}  // namespace isotach::mpm
