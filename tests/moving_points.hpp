// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Material points with a motion given to them, for tests and benches of materials alone.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mpm/material.hpp"

namespace isotach::tests {

/// Points and what a step does to them.
struct MovingPoints : mpm::Particles {
  std::array<std::vector<double>, 4> strain_rate;  ///< plane Mandel (1/s)
  std::vector<double> spin;                        ///< W_rz (1/s)

  /// n points, all zero, at rest; Omega is carried where they rotate.
  explicit MovingPoints(std::size_t n, bool rotates = false) {
    count = n;
    const std::size_t size = padded(n, mpm::kBlock);
    for_each_array([size](mpm::PointArray& array) { array.assign(size, 0.0); });
    if (!rotates) {
      for (auto& component : omega) component.clear();
    }
    for (auto& component : strain_rate) component.assign(size, 0.0);
    spin.assign(size, 0.0);
  }
};

/// One step of dt (s) of a material at all points.
inline mpm::MaterialCount update(const mpm::Material& material, MovingPoints& points, double dt) {
  mpm::MaterialCount count;
  mpm::MaterialChunk chunk;
  chunk.dt = dt;
  for (std::size_t begin = 0; begin < points.count; begin += mpm::kChunk) {
    chunk.begin = begin;
    chunk.count = std::min(mpm::kChunk, points.count - begin);
    const std::size_t padded = mpm::Particles::padded(chunk.count, mpm::kBlock);
    for (std::size_t k = 0; k < 4; ++k) {
      std::copy_n(&points.strain_rate[k][begin], padded, chunk.strain_rate[k].data());
    }
    std::copy_n(&points.spin[begin], padded, chunk.spin.data());
    material.update(points, chunk, count);
  }
  return count;
}

}  // namespace isotach::tests
