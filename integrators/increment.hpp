// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A loading increment: for each tensor component a strain rate or a condition on the stress rate, held for a
// time.
#pragma once

#include <array>

#include "model/mandel.hpp"

namespace isotach::integrators {

/// Loading at constant rates for `duration`. Components in Mandel order; tension positive.
///
/// Where component i is stress-controlled, its strain rate is free and the stress rate in fixed axes obeys
///
///   sum_j condition[i][j] dT_j/dt = stress_rate[i],
///
/// by default dT_i/dt = stress_rate[i]; other conditions lead along paths such as constant mean stress.
template <class S = double>
struct Increment {
  double duration = 0.0;                                              ///< s, >= 0
  model::Mandel<S> strain_rate = model::Mandel<S>::Constant(S(0.0));  ///< 1/s, where not stress-controlled
  model::Mandel<S> stress_rate = model::Mandel<S>::Constant(S(0.0));  ///< Pa/s, where stress-controlled
  std::array<bool, 6> stress_controlled{};
  Eigen::Matrix<double, 6, 6> condition = Eigen::Matrix<double, 6, 6>::Identity();
  Eigen::Matrix<S, 3, 1> spin = Eigen::Matrix<S, 3, 1>::Constant(S(0.0));  ///< W12, W13, W23 (1/s)

  [[nodiscard]] bool strain_driven() const {
    for (const bool controlled : stress_controlled) {
      if (controlled) return false;
    }
    return true;
  }

  /// The same increment with rates that are constants of another scalar.
  template <class T>
  [[nodiscard]] Increment<T> cast() const {
    Increment<T> result;
    result.duration = duration;
    result.strain_rate = strain_rate.template cast<T>();
    result.stress_rate = stress_rate.template cast<T>();
    result.stress_controlled = stress_controlled;
    result.condition = condition;
    result.spin = spin.template cast<T>();
    return result;
  }
};

/// Strain-driven increment.
template <class S>
[[nodiscard]] Increment<S> strain_increment(const model::Mandel<S>& strain_rate, double duration) {
  Increment<S> increment;
  increment.duration = duration;
  increment.strain_rate = strain_rate;
  return increment;
}

}  // namespace isotach::integrators
