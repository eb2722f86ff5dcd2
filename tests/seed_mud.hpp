// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the tests of slumps and of fits share: the mud of the seed paper.
#pragma once

#include "model/published_sets.hpp"

namespace isotach::tests {

using model::seed_mud_values;

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
