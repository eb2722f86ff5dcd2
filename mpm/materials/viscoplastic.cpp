// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/materials/viscoplastic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isotach::mpm {

void ViscoplasticMaterial::update(Particles& q, MaterialChunk& chunk, MaterialCount& count) const {
  for (std::size_t p = 0; p < chunk.count; ++p) {
    const std::size_t i = chunk.begin + p;
    const auto& D = chunk.strain_rate;
    const FlowElement::Components rate{D[0][p], D[1][p], D[2][p], D[3][p] / std::numbers::sqrt2};
    // volume: the midpoint rule for dJ/dt = J tr D
    const double x = 0.5 * chunk.dt * (rate.rr + rate.zz + rate.tt);
    q.void_ratio[i] += (1.0 + q.void_ratio[i]) * 2.0 * x / (1.0 - x);
    const FlowElement::Components t =
        element_.after({q.stress[0][i], q.stress[1][i], q.stress[2][i], q.stress[3][i] / std::numbers::sqrt2},
                       rate, chunk.spin[p], chunk.dt);
    q.stress[0][i] = t.rr;
    q.stress[1][i] = t.zz;
    q.stress[2][i] = t.tt;
    q.stress[3][i] = std::numbers::sqrt2 * t.rz;
  }
  total_pressure(q, chunk.begin, chunk.count, chunk.total_pressure.data());
  count.stiffest = std::max(count.stiffest, wave_modulus(q, chunk.begin));
}

void ViscoplasticMaterial::total_pressure(const Particles& q, std::size_t begin, std::size_t count,
                                          double* pressures) const {
  for (std::size_t p = 0; p < count; ++p) {
    pressures[p] = q.reference_pressure[begin + p] - bulk_modulus_ * std::log1p(q.void_ratio[begin + p]);
  }
}

double ViscoplasticMaterial::wave_modulus(const Particles& /*particles*/, std::size_t /*i*/) const {
  return bulk_modulus_ + 4.0 / 3.0 * element_.shear_modulus;
}

}  // namespace isotach::mpm
