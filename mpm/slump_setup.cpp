// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/slump_setup.hpp"

#include <algorithm>
#include <cstddef>

namespace isotach::mpm {

namespace {

/// The later end of the stretch of the table that holds at t.
std::size_t stretch_end(const std::vector<RimPlace>& table, double t) {
  const auto later = std::upper_bound(table.begin(), table.end(), t,
                                      [](double time, const RimPlace& place) { return time < place.time; });
  const auto index = static_cast<std::size_t>(later - table.begin());
  return std::clamp<std::size_t>(index, 1, table.size() - 1);
}

double speed_of(const std::vector<RimPlace>& table, std::size_t end) {
  return (table[end].height - table[end - 1].height) / (table[end].time - table[end - 1].time);
}

}  // namespace

double Mould::rim(double t) const {
  if (lift_table.empty()) return lift_speed * std::max(0.0, t - lift_delay);
  const double moved = t - lift_delay;
  if (moved <= lift_table.front().time) return lift_table.front().height;
  const std::size_t end = stretch_end(lift_table, moved);
  return lift_table[end - 1].height + speed_of(lift_table, end) * (moved - lift_table[end - 1].time);
}

double Mould::rim_velocity(double t) const {
  const double moved = t - lift_delay;
  if (lift_table.empty()) return moved < 0.0 ? 0.0 : lift_speed;
  if (moved < lift_table.front().time) return 0.0;
  return speed_of(lift_table, stretch_end(lift_table, moved));
}

Wall SlumpSetup::wall_at(double t) const {
  Wall wall = mould.wall;
  wall.adhesion = std::max(0.0, wall.adhesion + wander.in_time(WanderSlot::wall_in_time, t));
  return wall;
}

BaseFriction SlumpSetup::base_at(double t) const {
  BaseFriction friction = base.friction;
  friction.slip_length = std::max(0.0, friction.slip_length + wander.in_time(WanderSlot::base_in_time, t));
  return friction;
}

}  // namespace isotach::mpm
