// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A loading increment: for each tensor component a strain rate or a stress rate, held for a time.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "model/law.hpp"

namespace isotach::integrators {

/// Loading at constant rates for `duration`. Components in Mandel order; tension positive.
template <class S = double>
struct Increment {
  double duration = 0.0;                                              ///< s, >= 0
  model::Mandel<S> strain_rate = model::Mandel<S>::Constant(S(0.0));  ///< 1/s, where not stress-controlled
  model::Mandel<S> stress_rate =
      model::Mandel<S>::Constant(S(0.0));  ///< Pa/s in fixed axes, where stress-controlled
  std::array<bool, 6> stress_controlled{};
  Eigen::Matrix<S, 3, 1> spin = Eigen::Matrix<S, 3, 1>::Constant(S(0.0));  ///< W12, W13, W23 (1/s)

  [[nodiscard]] bool strain_driven() const {
    for (const bool controlled : stress_controlled) {
      if (controlled) return false;
    }
    return true;
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

/// Right-hand side dy/dt = F(y) of an increment: finds the free strain rates, then the rates of stress (fixed
/// axes) and void ratio. Keeps the last strain rate as the next start value; use one object per integration.
/// Refers to the law and the increment given, which must outlive it.
template <class S>
class LoadingRate {
 public:
  LoadingRate(const model::Law<S>& law, const Increment<S>& increment)
      : law_(law), increment_(increment), strain_rate_(increment.strain_rate) {
    for (int i = 0; i < 6; ++i) {
      if (increment.stress_controlled[static_cast<std::size_t>(i)])
        free_[static_cast<std::size_t>(free_count_++)] = i;
    }
    for (int i = 0; i < 3; ++i) rotates_ = rotates_ || model::value_of(increment.spin[i]) != 0.0;
  }

  /// False where the state is outside the law's domain or the free strain rates cannot be found; `rate` and
  /// strain_rate() then stay as they were.
  [[nodiscard]] bool operator()(const model::State<S>& state, model::StateRate<S>& rate) {
    if (!model::Law<S>::in_domain(state)) return false;
    if (free_count_ > 0 && !find_strain_rate(state)) return false;
    rate = law_.rate(state, strain_rate_);
    if (rotates_) rate.stress += model::corotation<S, 6>(state.stress, increment_.spin);
    return true;
  }

  /// Strain rate (1/s, Mandel) of the last call that returned true.
  [[nodiscard]] const model::Mandel<S>& strain_rate() const { return strain_rate_; }

 private:
  // Newton's method on the stress-controlled components. The law is linear in D but for C_1 m |D|, whose
  // derivative is C_1 (E:m) (x) D/|D|, so the matrix is exact and convergence quadratic: after a step below
  // the square root of round-off the value is at round-off, and one step more, with the matrix taken there,
  // brings the derivatives of S there too. The matrix is plain: at the solution that does not harm the
  // derivatives, while Eigen's triangular solvers skip zeros by value and so would drop derivatives.
  bool find_strain_rate(const model::State<S>& state) {
    using std::sqrt;
    constexpr int kMaxIterations = 50;
    constexpr double kSmallStep = 1e-8;  // of the largest strain rate
    const model::StressMeasures<S> at = law_.template measures<6>(state.stress);
    const S viscous = law_.viscous_rate(at.equivalent_pressure, state.void_ratio);
    const S& C_1 = law_.parameters().C_1();
    const model::Mandel<S> e_m = law_.stiffness_times(at, at.m);
    Eigen::Matrix<double, 6, 6> stiffness;
    for (int j = 0; j < 6; ++j) {
      model::Mandel<S> unit = model::Mandel<S>::Constant(S(0.0));
      unit[j] = S(1.0);
      const model::Mandel<S> column = law_.stiffness_times(at, unit);
      for (int i = 0; i < 6; ++i) stiffness(i, j) = model::value_of(column[i]);
    }
    model::Mandel<S> offset = -increment_.stress_rate;
    if (rotates_) offset += model::corotation<S, 6>(state.stress, increment_.spin);

    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6> jacobian(free_count_, free_count_);
    model::Mandel<S> trial = strain_rate_;
    bool converged = false;
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      const S norm = sqrt(trial.squaredNorm() + S(1e-300));
      const model::Mandel<S> residual =
          law_.stiffness_times(at, trial) - e_m * (viscous + C_1 * norm) + offset;
      for (int i = 0; i < free_count_; ++i) {
        const int row = free_component(i);
        const double hypoplastic = model::value_of(C_1 * e_m[row] / norm);
        for (int j = 0; j < free_count_; ++j) {
          const int column = free_component(j);
          jacobian(i, j) = stiffness(row, column) - hypoplastic * model::value_of(trial[column]);
        }
      }
      const auto inverse = jacobian.partialPivLu().inverse().eval();
      double change = 0.0;
      for (int i = 0; i < free_count_; ++i) {
        S step(0.0);
        for (int j = 0; j < free_count_; ++j) step += residual[free_component(j)] * S(inverse(i, j));
        if (!std::isfinite(model::value_of(step))) return false;
        change = std::max(change, std::abs(model::value_of(step)));
        trial[free_component(i)] -= step;
      }
      double size = model::value_of(viscous);
      for (int i = 0; i < 6; ++i) size = std::max(size, std::abs(model::value_of(trial[i])));
      if (converged) {
        strain_rate_ = trial;
        return true;
      }
      converged = change <= kSmallStep * size;
    }
    return false;
  }

  [[nodiscard]] int free_component(int i) const { return free_[static_cast<std::size_t>(i)]; }

  const model::Law<S>& law_;
  const Increment<S>& increment_;
  model::Mandel<S> strain_rate_;
  std::array<int, 6> free_{};
  int free_count_ = 0;
  bool rotates_ = false;
};

}  // namespace isotach::integrators
