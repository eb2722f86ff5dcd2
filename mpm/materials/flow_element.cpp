// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/materials/flow_element.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::mpm {

double FlowElement::flow_rate(double trial, double dt) const {
  const double excess = trial - yield_stress;
  const double elastic = shear_modulus * dt;
  if (flow_index == 1.0) return excess / (elastic + consistency);
  // excess = G dt g + k g^n grows with g: Newton's method within a bracket that closes
  double low = 0.0;
  double high = excess / elastic;
  if (consistency == 0.0) return high;
  double rate = std::min(high, std::pow(excess / consistency, 1.0 / flow_index));
  constexpr int kMostIterations = 100;
  constexpr double kLast = 1e-5;  // of the rate: after a step of Newton's so short the error is its square
  for (int n = 0; n < kMostIterations && high - low > 1e-14 * high; ++n) {
    const double viscous = consistency * std::pow(rate, flow_index);
    const double left = excess - elastic * rate - viscous;
    (left > 0.0 ? low : high) = rate;
    const double next = rate + left / (elastic + flow_index * viscous / rate);
    if (std::abs(next - rate) <= kLast * rate) return next;
    rate = next > low && next < high ? next : 0.5 * (low + high);
  }
  return rate;
}

FlowElement::Components FlowElement::after(const Components& stress, const Components& d, double spin,
                                           double dt) const {
  // half of the strain before the turn and half after it, so that the two commute to second order
  const double half = shear_modulus * dt;  // half of 2 G dt
  const double mean = (d.rr + d.zz + d.tt) / 3.0;
  const double c = std::cos(spin * dt);
  const double s = std::sin(spin * dt);
  const double rr = stress.rr + half * (d.rr - mean);
  const double zz = stress.zz + half * (d.zz - mean);
  const double rz = stress.rz + half * d.rz;
  Components t{c * c * rr + 2.0 * c * s * rz + s * s * zz + half * (d.rr - mean),
               s * s * rr - 2.0 * c * s * rz + c * c * zz + half * (d.zz - mean),
               stress.tt + 2.0 * half * (d.tt - mean),
               c * s * (zz - rr) + (c * c - s * s) * rz + half * d.rz};
  const double tau = std::sqrt(0.5 * (t.rr * t.rr + t.zz * t.zz + t.tt * t.tt) + t.rz * t.rz);
  if (tau > yield_stress) {
    const double factor = 1.0 - shear_modulus * dt * flow_rate(tau, dt) / tau;
    t = {t.rr * factor, t.zz * factor, t.tt * factor, t.rz * factor};
  }
  return t;
}

}  // namespace isotach::mpm
