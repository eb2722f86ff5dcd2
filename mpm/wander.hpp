// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One thing about a slump that is let wander: no physics, but the question what would have to change.
#pragma once

#include <vector>

namespace isotach::mpm {

/// What wanders, and over what: time and strain rate by their logarithms.
enum class WanderSlot {
  nothing,
  wall_in_time,        ///< adhesion of the mould's wall (Pa), over ln(t / 1 s)
  base_in_time,        ///< slip length of the base (m), over ln(t / 1 s)
  strength_in_time,    ///< ln p_B, over ln(t / 1 s)
  strength_in_height,  ///< ln p_B, over the height in the fill that the mud started from, 0 to 1
  strength_in_rate     ///< ln p_B, over ln(|D| 1 s)
};

/// A change that is added to a slot, as a polygon. OCR0 stays what the mud has it, of the p_B that a change
/// of strength makes at the start; a run's fields of OCR are without it.
struct Wander {
  WanderSlot slot = WanderSlot::nothing;
  std::vector<double> at = {};      ///< knots, increasing; at least one where something wanders
  std::vector<double> change = {};  ///< at them; beyond the first and the last it stays

  [[nodiscard]] double operator()(double x) const;
  [[nodiscard]] bool changes_strength() const { return slot >= WanderSlot::strength_in_time; }
  /// The change at t (s) where `which` wanders, over time; else zero.
  [[nodiscard]] double in_time(WanderSlot which, double t) const;
};

}  // namespace isotach::mpm
