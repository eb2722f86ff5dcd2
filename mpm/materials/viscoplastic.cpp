// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/materials/viscoplastic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isotach::mpm {

double ViscoplasticMaterial::flow_rate(double trial, double dt) const {
  const double excess = trial - constants_.yield_stress;
  const double elastic = constants_.shear_modulus * dt;
  if (constants_.flow_index == 1.0) return excess / (elastic + constants_.consistency);
  // excess = G dt g + k g^n grows with g: Newton's method within a bracket that closes
  double low = 0.0;
  double high = excess / elastic;
  if (constants_.consistency == 0.0) return high;
  double rate = std::min(high, std::pow(excess / constants_.consistency, 1.0 / constants_.flow_index));
  constexpr int kMostIterations = 100;
  for (int n = 0; n < kMostIterations && high - low > 1e-14 * high; ++n) {
    const double viscous = constants_.consistency * std::pow(rate, constants_.flow_index);
    const double left = excess - elastic * rate - viscous;
    (left > 0.0 ? low : high) = rate;
    const double next = rate + left / (elastic + constants_.flow_index * viscous / rate);
    if (std::abs(next - rate) <= 1e-14 * rate) return next;
    rate = next > low && next < high ? next : 0.5 * (low + high);
  }
  return rate;
}

void ViscoplasticMaterial::update(Particles& q, MaterialChunk& chunk, MaterialCount& count) const {
  const double two_G_dt = 2.0 * constants_.shear_modulus * chunk.dt;
  for (std::size_t p = 0; p < chunk.count; ++p) {
    const std::size_t i = chunk.begin + p;
    const double d_rr = chunk.strain_rate[0][p];
    const double d_zz = chunk.strain_rate[1][p];
    const double d_tt = chunk.strain_rate[2][p];
    const double volumetric = d_rr + d_zz + d_tt;
    const double mean = volumetric / 3.0;
    // volume: the midpoint rule for dJ/dt = J tr D
    const double x = 0.5 * chunk.dt * volumetric;
    q.void_ratio[i] += (1.0 + q.void_ratio[i]) * 2.0 * x / (1.0 - x);
    // half of the strain before the turn and half after it, so that the two commute to second order
    const double turn = chunk.spin[p] * chunk.dt;
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    const double rr = q.stress[0][i] + 0.5 * two_G_dt * (d_rr - mean);
    const double zz = q.stress[1][i] + 0.5 * two_G_dt * (d_zz - mean);
    const double rz =
        q.stress[3][i] / std::numbers::sqrt2 + 0.5 * two_G_dt * chunk.strain_rate[3][p] / std::numbers::sqrt2;
    double t_rr = c * c * rr + 2.0 * c * s * rz + s * s * zz + 0.5 * two_G_dt * (d_rr - mean);
    double t_zz = s * s * rr - 2.0 * c * s * rz + c * c * zz + 0.5 * two_G_dt * (d_zz - mean);
    double t_rz = c * s * (zz - rr) + (c * c - s * s) * rz +
                  0.5 * two_G_dt * chunk.strain_rate[3][p] / std::numbers::sqrt2;
    double t_tt = q.stress[2][i] + two_G_dt * (d_tt - mean);
    const double tau = std::sqrt(0.5 * (t_rr * t_rr + t_zz * t_zz + t_tt * t_tt) + t_rz * t_rz);
    if (tau > constants_.yield_stress) {
      const double factor = 1.0 - constants_.shear_modulus * chunk.dt * flow_rate(tau, chunk.dt) / tau;
      t_rr *= factor;
      t_zz *= factor;
      t_tt *= factor;
      t_rz *= factor;
    }
    q.stress[0][i] = t_rr;
    q.stress[1][i] = t_zz;
    q.stress[2][i] = t_tt;
    q.stress[3][i] = std::numbers::sqrt2 * t_rz;
  }
  total_pressure(q, chunk.begin, chunk.count, chunk.total_pressure.data());
  count.stiffest = std::max(count.stiffest, wave_modulus(q, chunk.begin));
}

void ViscoplasticMaterial::total_pressure(const Particles& q, std::size_t begin, std::size_t count,
                                          double* pressures) const {
  for (std::size_t p = 0; p < count; ++p) {
    pressures[p] =
        q.reference_pressure[begin + p] - constants_.bulk_modulus * std::log1p(q.void_ratio[begin + p]);
  }
}

double ViscoplasticMaterial::wave_modulus(const Particles& /*particles*/, std::size_t /*i*/) const {
  return constants_.bulk_modulus + 4.0 / 3.0 * constants_.shear_modulus;
}

}  // namespace isotach::mpm
