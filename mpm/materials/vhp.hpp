// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Undrained mud: the VHP law in effective stress, and pore water as a bulk modulus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "integrators/fellin_ostermann.hpp"
#include "mpm/material.hpp"

namespace isotach::mpm {

/// Midpoint steps (Fellin-Ostermann's accepted solution) for packs of points. Points that exceed the
/// tolerance are gathered into packs of their own, those that ask for most first, and done again in as many
/// equal substeps as the pack's worst error estimate asks for; a point that still exceeds it is done by
/// itself with adaptive substeps.
///
/// A point whose mean effective pressure would fall below `least_pressure` leaves the law's domain (the
/// skeleton loses contact); it is set to the isotropic stress of that pressure, Omega to zero, and counted.
///
/// The pore pressure is a function of the void ratio, u = reference_pressure - K_w ln e, from
/// du/dt = -(K_w/n) tr D, so that volume, void ratio and pressure cannot drift apart.
class VhpMaterial final : public Material {
 public:
  struct Settings {
    double tolerance = 3e-3;            ///< on EST relative to |T|, 1+e and 1+|Omega|, > 0
    double least_pressure = 1.0;        ///< Pa, > 0
    double water_bulk_modulus = 300e3;  ///< K_w (Pa), > 0
  };
  VhpMaterial(const model::Parameters<double>& parameters, const Settings& settings);

  void update(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const override;
  void total_pressure(const Particles& particles, std::size_t begin, std::size_t count,
                      double* pressures) const override;
  [[nodiscard]] double wave_modulus(const Particles& particles, std::size_t i) const override;

  /// reference_pressure of a point whose pore pressure is u (Pa) at void ratio e.
  [[nodiscard]] double reference_pressure(double pore_pressure, double void_ratio) const;
  /// u of point i (Pa).
  [[nodiscard]] double pore_pressure(const Particles& particles, std::size_t i) const;
  [[nodiscard]] const model::Law<double>& law() const { return law_; }

 private:
  /// A point that exceeded the tolerance in one step, and the number of substeps it asks for.
  struct Left {
    std::uint32_t entry;  ///< of the chunk
    int substeps;
  };

  [[nodiscard]] static std::size_t sort_by_substeps(std::span<Left> left);
  template <model::Fabric K>
  void update_form(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const;
  template <model::Fabric K>
  void update_left(Particles& particles, const MaterialChunk& chunk, std::span<Left> left,
                   MaterialCount& count) const;
  /// Updates the chunk's point p by substeps. Returns false where it ended at the least pressure.
  template <model::Fabric K>
  bool substep(Particles& particles, const MaterialChunk& chunk, std::size_t p) const;
  [[nodiscard]] double modulus(double pressure, double void_ratio) const;

  model::Law<double> law_;
  Settings settings_;
  double skeleton_factor_;  ///< plane wave modulus of the skeleton over p'
};

}  // namespace isotach::mpm
