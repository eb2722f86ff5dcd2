// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/plane_tie.hpp"

namespace isotach::mpm {

namespace {

bool empty(const Octet& node) {
  return node[kMass] <= kLeastNodeMass;
}

double force_r(const Octet& node) {
  return node[kInternalR] + node[kAppliedR];
}

double force_z(const Octet& node) {
  return node[kInternalZ] + node[kAppliedZ];
}

}  // namespace

std::optional<std::size_t> tie_planes(NodeSums& above, NodeSums& below) {
  const std::size_t top = below.rows() - 1;
  for (std::size_t i = 0; i < above.end(0); ++i) {
    Octet& outer = above.data()[i];  // beyond the plane, as seen from its side
    Octet& inner = above.data()[above.stride() + i];
    if (empty(outer)) continue;  // what lies above does not reach the plane
    if (i >= below.end(top)) return i;
    Octet& floor_outer = below.data()[top * below.stride() + i];
    Octet& floor_inner = below.data()[(top - 1) * below.stride() + i];
    if (empty(floor_outer)) return i;
    const double ease =
        1.0 / outer[kMass] + 1.0 / inner[kMass] + 1.0 / floor_outer[kMass] + 1.0 / floor_inner[kMass];
    // `of_node`, a momentum or force, over mass is alike on average; what that takes goes to the place `to`
    const auto tie = [&](auto&& of_node, std::size_t to) {
      const auto per_mass = [&](const Octet& node) { return of_node(node) / node[kMass]; };
      const double gap = per_mass(outer) + per_mass(inner) - per_mass(floor_outer) - per_mass(floor_inner);
      const double given = gap / ease;
      outer[to] -= given;
      inner[to] -= given;
      floor_outer[to] += given;
      floor_inner[to] += given;
    };
    tie([](const Octet& node) { return node[kMomentumR]; }, kMomentumR);
    tie([](const Octet& node) { return node[kMomentumZ]; }, kMomentumZ);
    tie(force_r, kAppliedR);
    tie(force_z, kAppliedZ);
  }
  return std::nullopt;
}

}  // namespace isotach::mpm
