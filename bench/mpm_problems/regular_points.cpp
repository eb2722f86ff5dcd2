// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/regular_points.hpp"

#include <cmath>

namespace isotach::bench {

mpm::Particles regular_points(double width, double height, double spacing, mpm::Symmetry symmetry,
                              double density) {
  mpm::Particles q;
  const auto columns = static_cast<std::size_t>(std::lround(width / spacing));
  const auto rows = static_cast<std::size_t>(std::lround(height / spacing));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double r = (static_cast<double>(column) + 0.5) * spacing;
      const double volume = spacing * spacing * (symmetry == mpm::Symmetry::axisymmetric ? r : 1.0);
      q.r.push_back(r);
      q.z.push_back((static_cast<double>(row) + 0.5) * spacing);
      q.mass.push_back(density * volume);
      q.solid_volume.push_back(volume);
    }
  }
  q.count = q.r.size();
  return q;
}

void Drag::add(const mpm::ForceBlock& block) const {
  const mpm::Particles& q = block.particles;
  for (std::size_t p = 0; p < block.count; ++p) {
    const double factor = rate_ * q.mass[block.begin + p];
    block.loads.add(p, -factor * q.velocity_r[block.begin + p], -factor * q.velocity_z[block.begin + p]);
  }
}

}  // namespace isotach::bench
