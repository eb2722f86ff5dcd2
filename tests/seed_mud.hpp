// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the tests of slumps and of fits share: the mud of the seed paper.
#pragma once

#include <numbers>

#include "model/parameters.hpp"

namespace isotach::tests {

/// Table 4 of the seed paper with its final I_v and C_1: e100 1.358, lambda 0.154, kappa 0.0129, I_v 0.02,
/// D_r 6.8e-7 /s, phi_c 14.2 deg, C_1 0.03.
inline model::ParameterValues<double> seed_mud_values() {
  model::ParameterValues<double> values;
  values[model::ParameterId::e100] = 1.358;
  values[model::ParameterId::lambda] = 0.154;
  values[model::ParameterId::kappa] = 0.0129;
  values[model::ParameterId::I_v] = 0.02;
  values[model::ParameterId::D_r] = 6.8e-7;
  values[model::ParameterId::phi_c] = 14.2 * std::numbers::pi / 180.0;
  values[model::ParameterId::C_1] = 0.03;
  return values;
}

inline model::Parameters<double> seed_mud() {
  return model::Parameters<double>::create(seed_mud_values()).value();
}

/// The same with one parameter changed (SI).
inline model::Parameters<double> seed_mud_with(model::ParameterId id, double value) {
  auto values = seed_mud_values();
  values[id] = value;
  return model::Parameters<double>::create(values).value();
}

}  // namespace isotach::tests
