// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the law asks of its scalar beside arithmetic, exp, log, sin and sqrt: the plain value.
#pragma once

#include <ceres/jet.h>

#include <cmath>

namespace isotach::model {

/// Plain value of a scalar, for decisions that must not be differentiated (bounds, step sizes).
[[nodiscard]] inline double value_of(double x) {
  return x;
}
template <class T, int N>
[[nodiscard]] double value_of(const ceres::Jet<T, N>& x) {
  return value_of(x.a);
}

/// 1/sqrt(x). A scalar that can do better has its own, found by argument-dependent lookup.
template <class S>
[[nodiscard]] S inverse_sqrt(const S& x) {
  using std::sqrt;
  return 1.0 / sqrt(x);
}
/// The same value; its derivative -y^3/2 in one product.
template <class T, int N>
[[nodiscard]] ceres::Jet<T, N> inverse_sqrt(const ceres::Jet<T, N>& x) {
  const T y = inverse_sqrt(x.a);
  return ceres::Jet<T, N>(y, x.v * (-0.5 * y * y * y));
}

/// Whether a scalar is zero with all of its derivatives, so that nothing depends on it.
[[nodiscard]] inline bool is_exactly_zero(double x) {
  return x == 0.0;
}
template <class T, int N>
[[nodiscard]] bool is_exactly_zero(const ceres::Jet<T, N>& x) {
  return is_exactly_zero(x.a) && x.v.isZero(0.0);
}

}  // namespace isotach::model
