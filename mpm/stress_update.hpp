// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The VHP law advanced over a time step at all material points, many at once.
#pragma once

#include <cstddef>

#include "integrators/fellin_ostermann.hpp"
#include "mpm/particles.hpp"

namespace isotach::mpm {

/// How often a step needed more than the common path.
struct StressUpdateCount {
  long substepped = 0;  ///< point updates that needed adaptive substeps of their own
  long floored = 0;     ///< point updates that ended at the least mean effective pressure
};

/// Midpoint steps (Fellin-Ostermann's accepted solution) for packs of points: one, or as many equal substeps
/// as the pack's worst error estimate asks for. A point that still exceeds the tolerance is done again by
/// itself with adaptive substeps.
///
/// A point whose mean effective pressure would fall below `least_pressure` leaves the law's domain (the
/// skeleton loses contact); it is set to the isotropic stress of that pressure, Omega to zero, and counted.
class StressUpdate {
 public:
  /// `tolerance` on EST relative to |T|, 1+e and 1+|Omega|, > 0; `least_pressure` in Pa, > 0.
  StressUpdate(const model::Parameters<double>& parameters, double tolerance, double least_pressure);

  /// Updates stress, void ratio and, where the material rotates, Omega of all points from their strain_rate
  /// and spin over `dt` (s).
  StressUpdateCount update(Particles& particles, double dt) const;

 private:
  template <model::Fabric K>
  StressUpdateCount update_form(Particles& particles, double dt) const;
  /// Updates point i by substeps. Returns false where it ended at the least pressure.
  template <model::Fabric K>
  bool substep(Particles& particles, std::size_t i, double dt) const;

  model::Law<double> law_;
  double tolerance_;
  double least_pressure_;
};

}  // namespace isotach::mpm
