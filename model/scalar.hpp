// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the law asks of its scalar beside arithmetic, exp, log, sin and sqrt: the plain value.
#pragma once

#include <ceres/jet.h>

namespace isotach::model {

/// Plain value of a scalar, for decisions that must not be differentiated (bounds, step sizes).
[[nodiscard]] inline double value_of(double x) {
  return x;
}
template <class T, int N>
[[nodiscard]] double value_of(const ceres::Jet<T, N>& x) {
  return value_of(x.a);
}

}  // namespace isotach::model
