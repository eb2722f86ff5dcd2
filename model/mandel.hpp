// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mandel (Kelvin) vectors of symmetric second-order tensors, and every conversion to and from them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace isotach::model {

/// Number of components of a general symmetric tensor in Mandel form.
inline constexpr int kGeneral = 6;
/// Number of components where one direction is principal: plane strain and axisymmetry.
inline constexpr int kPlane = 4;
/// Number of components where two principal values are equal: confined and triaxial compression.
inline constexpr int kAxial = 2;

/// Symmetric second-order tensor as a Mandel vector, so that a.dot(b) is the double contraction and a.norm()
/// the Frobenius norm.
///
/// N = 6: (A11, A22, A33, sqrt2 A12, sqrt2 A13, sqrt2 A23).
/// N = 4: (A11, A22, A33, sqrt2 A12), with A13 = A23 = 0 (axisymmetry: 1 = r, 2 = z, 3 = hoop).
/// N = 2: (A11, sqrt2 A22), with A22 = A33 and no shear (1 = axial, 2 = 3 = radial).
template <class S, int N = kGeneral>
using Mandel = Eigen::Matrix<S, N, 1>;

/// Number of components of the unit tensor that are not zero, the first ones.
template <int N>
inline constexpr int kNormal = N == kAxial ? 2 : 3;

/// Unit tensor.
template <class S, int N = kGeneral>
[[nodiscard]] Mandel<S, N> unit_tensor() {
  Mandel<S, N> one = Mandel<S, N>::Constant(S(0.0));
  one[0] = one[1] = S(1.0);
  if constexpr (N == kAxial) {
    one[1] = S(std::numbers::sqrt2);
  } else {
    one[2] = S(1.0);
  }
  return one;
}

/// A value of the same size in every direction, as component i < kNormal<N> of its Mandel vector.
template <int N, class S>
[[nodiscard]] S normal_component(int i, const S& value) {
  if constexpr (N == kAxial) {
    return i == 0 ? value : value * std::numbers::sqrt2;
  } else {
    return value;
  }
}

template <class S, int N>
[[nodiscard]] S trace(const Mandel<S, N>& a) {
  if constexpr (N == kAxial) {
    return a[0] + a[1] * std::numbers::sqrt2;
  } else {
    return a[0] + a[1] + a[2];
  }
}

/// Double contraction a : b. Component by component, as everything that the law does with double: a store by
/// components that is soon after read as a vector, as Eigen's dot() does, stalls the processor.
template <class S, int N>
[[nodiscard]] S contraction(const Mandel<S, N>& a, const Mandel<S, N>& b) {
  S even = a[0] * b[0];
  S odd = a[1] * b[1];
  for (int i = 2; i < N; i += 2) {
    even += a[i] * b[i];
    odd += a[i + 1] * b[i + 1];
  }
  return even + odd;
}

/// a - tr(a)/3 1.
template <class S, int N>
[[nodiscard]] Mandel<S, N> deviator(const Mandel<S, N>& a) {
  const S mean = trace<S, N>(a) * S(1.0 / 3.0);
  Mandel<S, N> d = a;
  for (int i = 0; i < kNormal<N>; ++i) d[i] -= normal_component<N>(i, mean);
  return d;
}

/// Determinant of the tensor whose Mandel vector is `a`.
template <class S, int N>
[[nodiscard]] S determinant(const Mandel<S, N>& a) {
  static_assert(N == kGeneral || N == kPlane || N == kAxial);
  if constexpr (N == kAxial) {
    return a[0] * (a[1] * a[1]) * 0.5;
  } else {
    S result = a[0] * a[1] * a[2] - a[2] * (a[3] * a[3]) * S(0.5);
    if constexpr (N == kGeneral) {
      result += a[3] * a[4] * a[5] * S(1.0 / std::numbers::sqrt2);
      result -= (a[1] * (a[4] * a[4]) + a[0] * (a[5] * a[5])) * S(0.5);
    }
    return result;
  }
}

/// 3x3 matrix of a Mandel vector.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, 3, 3> matrix_from_mandel(const Mandel<S, N>& a) {
  const S h(1.0 / std::numbers::sqrt2);
  const S zero(0.0);
  const S a12 = a[3] * h;
  S a13 = zero;
  S a23 = zero;
  if constexpr (N == kGeneral) {
    a13 = a[4] * h;
    a23 = a[5] * h;
  }
  Eigen::Matrix<S, 3, 3> m;
  m << a[0], a12, a13, a12, a[1], a23, a13, a23, a[2];
  return m;
}

/// Mandel vector of the symmetric part of a 3x3 matrix. For N = 4 the components 13 and 23 are dropped.
template <class S, int N = kGeneral>
[[nodiscard]] Mandel<S, N> mandel_from_matrix(const Eigen::Matrix<S, 3, 3>& m) {
  const S h(1.0 / std::numbers::sqrt2);
  Mandel<S, N> a;
  a[0] = m(0, 0);
  a[1] = m(1, 1);
  a[2] = m(2, 2);
  a[3] = (m(0, 1) + m(1, 0)) * h;
  if constexpr (N == kGeneral) {
    a[4] = (m(0, 2) + m(2, 0)) * h;
    a[5] = (m(1, 2) + m(2, 1)) * h;
  }
  return a;
}

/// Mandel vector from tensor components in the order 11, 22, 33, 12, 13, 23.
template <class S>
[[nodiscard]] Mandel<S> mandel_from_components(const Eigen::Matrix<S, 6, 1>& c) {
  Mandel<S> a = c;
  a.template tail<3>() *= S(std::numbers::sqrt2);
  return a;
}

/// Tensor components in the order 11, 22, 33, 12, 13, 23 of a Mandel vector.
template <class S>
[[nodiscard]] Eigen::Matrix<S, 6, 1> components_from_mandel(const Mandel<S>& a) {
  Eigen::Matrix<S, 6, 1> c = a;
  c.template tail<3>() *= S(1.0 / std::numbers::sqrt2);
  return c;
}

/// Mandel vector of a stress given in Voigt form (11, 22, 33, 12, 13, 23), shear as tensor components.
template <class S>
[[nodiscard]] Mandel<S> mandel_from_voigt_stress(const Eigen::Matrix<S, 6, 1>& voigt) {
  return mandel_from_components<S>(voigt);
}

/// Mandel vector of a strain given in Voigt form (11, 22, 33, 12, 13, 23), shear as engineering strain 2
/// eps_ij.
template <class S>
[[nodiscard]] Mandel<S> mandel_from_voigt_strain(const Eigen::Matrix<S, 6, 1>& voigt) {
  Mandel<S> a = voigt;
  a.template tail<3>() *= S(1.0 / std::numbers::sqrt2);
  return a;
}

/// Voigt stress (tensor shear) of a Mandel vector.
template <class S>
[[nodiscard]] Eigen::Matrix<S, 6, 1> voigt_stress_from_mandel(const Mandel<S>& a) {
  return components_from_mandel<S>(a);
}

/// Voigt strain (engineering shear) of a Mandel vector.
template <class S>
[[nodiscard]] Eigen::Matrix<S, 6, 1> voigt_strain_from_mandel(const Mandel<S>& a) {
  Eigen::Matrix<S, 6, 1> v = a;
  v.template tail<3>() *= S(std::numbers::sqrt2);
  return v;
}

/// Rate W T - T W that turns a corotational (Jaumann) rate into the rate in fixed axes.
///
/// `spin` holds W12, W13, W23 (1/s), W_ij = (dv_i/dx_j - dv_j/dx_i)/2; for N = 4 only W12 is used.
template <class S, int N>
[[nodiscard]] Mandel<S, N> corotation(const Mandel<S, N>& t, const Eigen::Matrix<S, 3, 1>& spin) {
  if constexpr (N == kPlane) {
    // W = [[0, w], [-w, 0]]: (W T - T W)_11 = 2 w T12, _22 = -2 w T12, _12 = w (T22 - T11)
    Mandel<S, N> rate;
    const S s = S(std::numbers::sqrt2) * spin[0];
    rate[0] = s * t[3];
    rate[1] = -rate[0];
    rate[2] = S(0.0);
    rate[3] = s * (t[1] - t[0]);
    return rate;
  } else {
    Eigen::Matrix<S, 3, 3> w;
    const S zero(0.0);
    w << zero, spin[0], spin[1], -spin[0], zero, spin[2], -spin[1], -spin[2], zero;
    const Eigen::Matrix<S, 3, 3> m = matrix_from_mandel<S, N>(t);
    const Eigen::Matrix<S, 3, 3> rate = w * m - m * w;
    return mandel_from_matrix<S, N>(rate);
  }
}

}  // namespace isotach::model
