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
  const double rim = mould_.rim(block.time);
  const double rim_velocity = mould_.rim_velocity(block.time);
  for (std::size_t p = 0; p < block.count; p += kOctet) {
    // most points are far from the wall: eight at a time
    const std::size_t first = block.begin + p;
    const Octet pressure = load_octet(&q.reference_pressure[first]) + constants_.initial_pressure_shift;
    const Octet depth =
        load_octet(&q.r[first]) + (half_size_ - radius_) + pressure / constants_.normal_stiffness;
    const IntegerOctet near = (depth > 0.0) & (load_octet(&q.z[first]) + half_size_ > rim);
    if (!any(near)) continue;
    for (std::size_t lane = 0; lane < std::min(kOctet, block.count - p); ++lane) {
      if (near[lane] == 0) continue;
      const std::size_t i = first + lane;
      const WallForce f = force({q.r[i], q.z[i], q.velocity_r[i], q.velocity_z[i], q.mass[i],
                                 -block.stress_rr[p + lane], pressure[lane]},
                                rim, rim_velocity, block.dt);
      block.force_r[p + lane] += f.r;
      block.force_z[p + lane] += f.z;
    }
  }
}

WallForce MouldContact::force(const WallPoint& point, double rim, double rim_velocity, double dt) const {
  const double depth = point.r + half_size_ - radius_ + point.initial_pressure / constants_.normal_stiffness;
  const double covered = point.z + half_size_ - rim;
  // beyond 2 half sizes the point has left through the gap below the rim and stands outside
  if (depth <= 0.0 || covered <= 0.0 || depth > 2.0 * half_size_) return {};
  const double share = std::min(1.0, covered / (2.0 * half_size_));
  double traction =
      std::max(0.0, constants_.normal_stiffness * depth + constants_.normal_damping * point.velocity_r);
  if (share < 1.0) traction = std::min(traction, share * std::max(point.radial_pressure, 0.0));
  const double area = radius_ * 2.0 * half_size_;
  WallForce f;
  f.r = -traction * area;
  if (!mould_.wall.is_smooth()) {
    const double stick = share * kStick * point.mass * (rim_velocity - point.velocity_z) / dt;
    const double limit = (share * mould_.wall.adhesion + mould_.wall.friction * traction) * area;
    f.z = std::clamp(stick, -limit, limit);
  }
  return f;
}

}  // namespace isotach::mpm
