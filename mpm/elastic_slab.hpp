// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The linear-elastic slab that a slump may stand on.
#pragma once

namespace isotach::mpm {

/// A round slab about the axis, held on its lower face. SI.
///
/// Thickness and length are those of Pippi et al.'s simulations (a base 5 mm thick and 0.2 m long in the
/// meridian plane), who do not say how stiff it is. By default it is stiff enough to leave no trace in an
/// outline, 140 mm of mud press it in by 7 micrometres, and soft enough for explicit steps hardly shorter
/// than the mud's: its waves run at 23 m/s, the mud's at 17 m/s. The number of steps goes with the root of
/// the modulus: with concrete's 30 GPa it would be 170 times as large, for a settlement of 0.2 nanometres.
struct ElasticSlab {
  double thickness = 0.005;     ///< m, > 0
  double length = 0.2;          ///< m, > 0; from the axis to the edge
  double youngs_modulus = 1e6;  ///< E (Pa), > 0
  double poissons_ratio = 0.3;  ///< nu (-), in [0, 0.5)

  /// Modulus of compression without lateral strain (Pa): (1 - nu) E/((1 + nu)(1 - 2 nu)).
  [[nodiscard]] double confined_modulus() const {
    return (1.0 - poissons_ratio) * youngs_modulus / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio));
  }
  /// How far a pressure (Pa) on much of its face presses the face in (m).
  [[nodiscard]] double settlement(double pressure) const { return pressure * thickness / confined_modulus(); }
};

/// Part of a cell by which the fill may press the face in: what stands on it meets it where it was at the
/// start.
inline constexpr double kLargestSettlement = 0.05;

}  // namespace isotach::mpm
