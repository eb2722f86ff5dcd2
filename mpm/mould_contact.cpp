// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/mould_contact.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/octet.hpp"

namespace isotach::mpm {

namespace {

// Part of the slip velocity that the wall takes away in a step: below 1 for stability with neighbours that
// share nodes, and gone within a few steps.
constexpr double kStick = 0.25;

}  // namespace

void MouldContact::add(const ForceBlock& block) const {
  const Particles& q = block.particles;
  const double rim = setup_.mould.rim(block.time);
  const double rim_velocity = setup_.mould.rim_velocity(block.time);
  const Wall wall = setup_.wall_at(block.time);
  for (std::size_t p = 0; p < block.count; p += kOctet) {
    // most points are far from the wall: eight at a time
    const std::size_t first = block.begin + p;
    const Octet depth = load_octet(&q.r[first]) + (half_size_ - radius_) + preload(load_octet(&q.z[first]));
    const IntegerOctet near = (depth > 0.0) & (load_octet(&q.z[first]) + half_size_ > rim);
    if (!any(near)) continue;
    for (std::size_t lane = 0; lane < std::min(kOctet, block.count - p); ++lane) {
      if (near[lane] == 0) continue;
      const std::size_t i = first + lane;
      // at the wall, but for points that are more than half outside
      const double r = std::max(q.r[i], radius_);
      const double arm = r - q.r[i];
      const WallForce f = force({q.r[i], q.z[i], q.velocity_r[i] + arm * q.c_rr[i],
                                 q.velocity_z[i] + arm * q.c_zr[i], q.mass[i], -block.stress_rr[p + lane]},
                                wall, rim, rim_velocity, block.dt);
      if (f.r != 0.0 || f.z != 0.0) block.loads.add_at(r, q.z[i], f.r, f.z);
    }
  }
}

double MouldContact::outer_traction(const WallPoint& point, double pressure) const {
  const double depth = radius_ + half_size_ - point.r;
  if (depth <= 0.0) return 0.0;
  return std::clamp(constants_.normal_stiffness * depth - constants_.normal_damping * point.velocity_r, 0.0,
                    pressure);
}

WallForce MouldContact::force(const WallPoint& point, const Wall& wall, double rim, double rim_velocity,
                              double dt) const {
  const double covered = point.z + half_size_ - rim;
  if (covered <= 0.0) return {};
  const double share = std::min(1.0, covered / (2.0 * half_size_));
  const double pressure = share * std::max(point.radial_pressure, 0.0);
  const double area = radius_ * 2.0 * half_size_;
  if (point.r > radius_) return {outer_traction(point, pressure) * area, 0.0};
  const double depth = point.r + half_size_ - radius_ + std::max(0.0, preload(point.z));
  if (depth <= 0.0) return {};
  // a point that is deeper than firm has come from elsewhere, round the rim, and to answer with the wall's
  // stiffness would shoot it through the mud
  const double firm = constants_.firm_depth;
  const double most =
      share < 1.0
          ? pressure
          : std::max(pressure, constants_.normal_stiffness * std::clamp(2.0 * firm - depth, 0.0, firm));
  const double traction = std::clamp(
      constants_.normal_stiffness * depth + constants_.normal_damping * point.velocity_r, 0.0, most);
  WallForce f;
  f.r = -traction * area;
  if (!wall.is_smooth()) {
    const double stick = share * kStick * point.mass * (rim_velocity - point.velocity_z) / dt;
    const double limit = (share * wall.adhesion + wall.friction * traction) * area;
    f.z = std::clamp(stick, -limit, limit);
  }
  return f;
}

}  // namespace isotach::mpm
