// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Linear elasticity up to a yield stress, and Herschel-Bulkley flow beyond it.
#pragma once

#include <limits>

#include "mpm/material.hpp"

namespace isotach::mpm {

/// The deviatoric stress is elastic (Jaumann rate, turned exactly by the step's rotation) below the yield
/// stress tau_y; beyond it, with tau = |T*|/sqrt 2 and g the plastic shear rate,
///
///   tau = tau_y + k g^n,  dtau/dt = G (gamma_rate - g),
///
/// stepped implicitly. No yield stress in reach: an elastic body. tau_y = 0, n = 1: a Maxwell fluid,
/// Newtonian for shear slower than G/k. The yield surface is von Mises'.
///
/// The total pressure is reference_pressure - K ln J, J = 1 + void_ratio; the points' stress stays
/// deviatoric.
class ViscoplasticMaterial final : public Material {
 public:
  struct Constants {
    double bulk_modulus;                                            ///< K (Pa), > 0
    double shear_modulus;                                           ///< G (Pa), > 0
    double yield_stress = std::numeric_limits<double>::infinity();  ///< tau_y (Pa), >= 0
    double consistency = 0.0;                                       ///< k (Pa s^n), >= 0
    double flow_index = 1.0;                                        ///< n (-), > 0
  };
  explicit ViscoplasticMaterial(const Constants& constants) : constants_(constants) {}

  void update(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const override;
  void total_pressure(const Particles& particles, std::size_t begin, std::size_t count,
                      double* pressures) const override;
  [[nodiscard]] double wave_modulus(const Particles& particles, std::size_t i) const override;

  /// Plastic shear rate (1/s) of a step of dt (s) whose elastic trial stress tau (Pa) is beyond the yield
  /// stress.
  [[nodiscard]] double flow_rate(double trial, double dt) const;

 private:
  Constants constants_;
};

}  // namespace isotach::mpm
