// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The state of a material point, its rate of change, and the arithmetic that integrators need of both.
#pragma once

#include "model/mandel.hpp"
#include "model/scalar.hpp"

namespace isotach::model {

/// Whether a state carries the anisotropy tensor. The law is the same; where Omega = 0 and C_2 = C_3 = 0 the
/// two give the same stress and void ratio to the last bit, and `none` saves the work.
enum class Fabric { none, omega };

/// State of a material point.
template <class S, int N = kGeneral, Fabric K = Fabric::omega>
struct State {
  Mandel<S, N> stress;                                  ///< effective Cauchy stress T (Pa), tension positive
  S void_ratio;                                         ///< e (-)
  Mandel<S, N> omega = Mandel<S, N>::Constant(S(0.0));  ///< anisotropy tensor Omega (-), deviatoric
};

template <class S, int N>
struct State<S, N, Fabric::none> {
  Mandel<S, N> stress;
  S void_ratio;
};

/// Time derivative of a State; stress and Omega corotational (Jaumann) unless said otherwise.
template <class S, int N = kGeneral, Fabric K = Fabric::omega>
struct StateRate {
  Mandel<S, N> stress;                                  ///< Pa/s
  S void_ratio;                                         ///< 1/s
  Mandel<S, N> omega = Mandel<S, N>::Constant(S(0.0));  ///< 1/s
};

template <class S, int N>
struct StateRate<S, N, Fabric::none> {
  Mandel<S, N> stress;
  S void_ratio;
};

/// y + f h for a time h (s). H may be double for any S.
template <class S, int N, Fabric K, class H>
[[nodiscard]] State<S, N, K> advanced(const State<S, N, K>& y, const StateRate<S, N, K>& f, const H& h) {
  State<S, N, K> result;
  for (int i = 0; i < N; ++i) result.stress[i] = y.stress[i] + f.stress[i] * h;
  result.void_ratio = y.void_ratio + f.void_ratio * h;
  if constexpr (K == Fabric::omega) {
    for (int i = 0; i < N; ++i) result.omega[i] = y.omega[i] + f.omega[i] * h;
  }
  return result;
}

/// Adds the rate W A - A W of stress and Omega, which turns corotational rates into rates in fixed axes.
template <class S, int N, Fabric K>
void add_corotation(StateRate<S, N, K>& rate, const State<S, N, K>& state,
                    const Eigen::Matrix<S, 3, 1>& spin) {
  const Mandel<S, N> turn = corotation<S, N>(state.stress, spin);
  for (int i = 0; i < N; ++i) rate.stress[i] += turn[i];
  if constexpr (K == Fabric::omega) rate.omega += corotation<S, N>(state.omega, spin);
}

/// Plain values of a tensor.
template <class S, int N>
[[nodiscard]] Mandel<double, N> plain(const Mandel<S, N>& a) {
  Mandel<double, N> result;
  for (int i = 0; i < N; ++i) result[i] = value_of(a[i]);
  return result;
}

/// Plain values of a state.
template <class S, int N, Fabric K>
[[nodiscard]] State<double, N, K> plain(const State<S, N, K>& state) {
  State<double, N, K> result;
  result.stress = plain<S, N>(state.stress);
  result.void_ratio = value_of(state.void_ratio);
  if constexpr (K == Fabric::omega) result.omega = plain<S, N>(state.omega);
  return result;
}

/// The state with an Omega of zero.
template <class S, int N>
[[nodiscard]] State<S, N> with_omega(const State<S, N, Fabric::none>& state) {
  return {state.stress, state.void_ratio};
}
template <class S, int N>
[[nodiscard]] const State<S, N>& with_omega(const State<S, N>& state) {
  return state;
}

/// An axial state in six components.
template <class S>
[[nodiscard]] State<S> general(const State<S, kAxial>& state) {
  const auto expanded = [](const Mandel<S, kAxial>& a) {
    Mandel<S> result = Mandel<S>::Constant(S(0.0));
    result[0] = a[0];
    result[1] = result[2] = a[1] * (1.0 / std::numbers::sqrt2);
    return result;
  };
  return {expanded(state.stress), state.void_ratio, expanded(state.omega)};
}

/// The state in that form: for Fabric::none its Omega is left out, which must be zero.
template <Fabric K, class S, int N>
[[nodiscard]] State<S, N, K> in_form(const State<S, N>& state) {
  if constexpr (K == Fabric::omega) {
    return state;
  } else {
    return {state.stress, state.void_ratio};
  }
}

/// The same state as a constant of another scalar.
template <class T, int N, Fabric K>
[[nodiscard]] State<T, N, K> cast(const State<double, N, K>& state) {
  State<T, N, K> result;
  for (int i = 0; i < N; ++i) result.stress[i] = T(state.stress[i]);
  result.void_ratio = T(state.void_ratio);
  if constexpr (K == Fabric::omega) {
    for (int i = 0; i < N; ++i) result.omega[i] = T(state.omega[i]);
  }
  return result;
}

}  // namespace isotach::model
