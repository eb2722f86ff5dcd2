// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A point of the slumping mud of test 1 and its motion: what the benchmarks of the law are run on.
#pragma once

#include "integrators/fellin_ostermann.hpp"
#include "model/law.hpp"
#include "model/published_sets.hpp"

namespace isotach::bench {

/// The seed's mud, Omega rotating where C_2 > 0.
inline model::Parameters<double> slump_mud(double C_2 = 0.0, double C_3 = 0.0) {
  auto values = model::seed_mud_values();
  values[model::ParameterId::C_2] = C_2;
  values[model::ParameterId::C_3] = C_3;
  return model::Parameters<double>::create(values).value();
}

inline constexpr double kVoidRatio = 3.891;
inline constexpr double kPressure = 584.0;  // Pa
inline constexpr double kRate = 0.1;        // 1/s
inline constexpr double kStep = 2e-4;       // s

/// The slump's tolerance, with which a step of the size of kStep takes one substep.
inline integrators::Tolerance slump_tolerance() {
  integrators::Tolerance tolerance;
  tolerance.relative = 3e-3;
  tolerance.estimate_share = 1.0;
  return tolerance;
}

/// Sheared state, Omega = 0.
template <int N, model::Fabric K>
model::State<double, N, K> slump_state() {
  model::State<double, N, K> state{model::unit_tensor<double, N>() * -kPressure, kVoidRatio};
  state.stress[0] *= 1.1;
  state.stress[1] *= 0.9;
  state.stress[3] = 0.1 * kPressure;
  return state;
}

/// Isochoric shear.
template <int N>
model::Mandel<double, N> slump_strain_rate() {
  model::Mandel<double, N> strain_rate = model::Mandel<double, N>::Zero();
  strain_rate[0] = -kRate;
  strain_rate[1] = kRate;
  strain_rate[3] = 0.5 * kRate;
  return strain_rate;
}

}  // namespace isotach::bench
