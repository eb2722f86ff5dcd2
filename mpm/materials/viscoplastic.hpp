// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Linear elasticity up to a yield stress, and Herschel-Bulkley flow beyond it.
#pragma once

#include <limits>

#include "mpm/material.hpp"
#include "mpm/materials/flow_element.hpp"

namespace isotach::mpm {

/// The deviatoric stress is that of a FlowElement. No yield stress in reach: an elastic body. tau_y = 0,
/// n = 1: a Maxwell fluid, Newtonian for shear slower than G/k.
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
  explicit ViscoplasticMaterial(const Constants& constants)
      : bulk_modulus_(constants.bulk_modulus),
        element_{constants.shear_modulus, constants.yield_stress, constants.consistency,
                 constants.flow_index} {}

  void update(Particles& particles, MaterialChunk& chunk, MaterialCount& count) const override;
  void total_pressure(const Particles& particles, std::size_t begin, std::size_t count,
                      double* pressures) const override;
  [[nodiscard]] double wave_modulus(const Particles& particles, std::size_t i) const override;

 private:
  double bulk_modulus_;
  FlowElement element_;
};

}  // namespace isotach::mpm
