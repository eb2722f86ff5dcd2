// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Sets of parameters that reference numbers and reports refer to by name.
#pragma once

#include <numbers>

#include "model/parameters.hpp"

namespace isotach::model {

/// Set A, for which the reference numbers of the law were computed outside the project: e100 1.5, lambda 0.1,
/// kappa 0.02, I_v 0.05, D_r 1e-6 /s, phi_c 25 deg, C_1 = C_2 = C_3 = 0.
[[nodiscard]] inline ParameterValues<double> set_a_values() {
  ParameterValues<double> values;
  values[ParameterId::e100] = 1.5;
  values[ParameterId::lambda] = 0.1;
  values[ParameterId::kappa] = 0.02;
  values[ParameterId::I_v] = 0.05;
  values[ParameterId::D_r] = 1e-6;
  values[ParameterId::phi_c] = 25.0 * std::numbers::pi / 180.0;
  return values;
}

/// The mud of Pippi, Martinelli, Tamagnini and Luger, "Simulation of a mini slump test using a
/// visco-hypoplastic constitutive model in an MPM code", Table 4 with the final I_v and C_1.
[[nodiscard]] inline ParameterValues<double> seed_mud_values() {
  ParameterValues<double> values;
  values[ParameterId::e100] = 1.358;
  values[ParameterId::lambda] = 0.154;
  values[ParameterId::kappa] = 0.0129;
  values[ParameterId::I_v] = 0.02;
  values[ParameterId::D_r] = 6.8e-7;
  values[ParameterId::phi_c] = 14.2 * std::numbers::pi / 180.0;
  values[ParameterId::C_1] = 0.03;
  return values;
}

}  // namespace isotach::model
