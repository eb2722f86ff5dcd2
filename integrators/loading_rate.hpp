// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The right-hand side of an increment as integrators see it: state to rate, with the free strain rates found.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "integrators/increment.hpp"
#include "model/law.hpp"

namespace isotach::integrators {

/// Right-hand side dy/dt = F(y) of an increment: finds the free strain rates, then the rates of stress, Omega
/// (fixed axes) and void ratio. Keeps the last strain rate as the next start value; use one object per
/// integration. Refers to the law and the increment given, which must outlive it. P is the scalar of the
/// law's parameters, S that of state and increment.
template <class S, class P = S, model::Fabric K = model::Fabric::omega>
class LoadingRate {
 public:
  using State = model::State<S, model::kGeneral, K>;
  using Rate = model::StateRate<S, model::kGeneral, K>;

  LoadingRate(const model::Law<P>& law, const Increment<S>& increment)
      : law_(law), increment_(increment), strain_rate_(increment.strain_rate) {
    for (int i = 0; i < 6; ++i) {
      if (increment.stress_controlled[static_cast<std::size_t>(i)])
        free_[static_cast<std::size_t>(free_count_++)] = i;
    }
    for (int i = 0; i < 3; ++i) rotates_ = rotates_ || model::value_of(increment.spin[i]) != 0.0;
    norm_ = model::norm_of<S, 6>(strain_rate_);
  }

  /// False where the state is outside the law's domain or the free strain rates cannot be found; `rate` and
  /// strain_rate() then stay as they were.
  [[nodiscard]] bool operator()(const State& state, Rate& rate) {
    if (!contains(state)) return false;
    if (free_count_ > 0 && !find_strain_rate(state)) return false;
    rate = law_.rate(state, strain_rate_, norm_);
    if (rotates_) model::add_corotation(rate, state, increment_.spin);
    return true;
  }

  /// Whether the law is defined at the state.
  [[nodiscard]] bool contains(const State& state) const { return law_.in_domain(state); }

  /// Strain rate (1/s, Mandel) of the last call that returned true.
  [[nodiscard]] const model::Mandel<S>& strain_rate() const { return strain_rate_; }

 private:
  // Newton's method on the stress-controlled components. The law is linear in D but for C_1 m |D|, whose
  // derivative is C_1 (E:m) (x) D/|D|, so the matrix is exact and convergence quadratic: after a step below
  // the square root of round-off the value is at round-off, and one step more, with the matrix taken there,
  // brings the derivatives of S there too. The matrix is plain: at the solution that does not harm the
  // derivatives, while Eigen's triangular solvers skip zeros by value and so would drop derivatives.
  bool find_strain_rate(const State& state) {
    constexpr int kMaxIterations = 50;
    constexpr double kSmallStep = 1e-8;  // of the largest strain rate
    const model::StressMeasures<S> at = law_.measures(state);
    const S viscous = law_.viscous_rate(at.equivalent_pressure, state.void_ratio);
    const P& C_1 = law_.parameters().C_1();
    const model::Mandel<S> e_m = law_.stiffness_times(at, at.m);
    Eigen::Matrix<double, 6, 6> stiffness;
    for (int j = 0; j < 6; ++j) {
      model::Mandel<S> unit = model::Mandel<S>::Constant(S(0.0));
      unit[j] = S(1.0);
      stiffness.col(j) = model::plain<S, 6>(law_.stiffness_times(at, unit));
    }
    const model::Mandel<double> plain_e_m = model::plain<S, 6>(e_m);
    model::Mandel<S> offset = model::Mandel<S>::Constant(S(0.0));
    if (rotates_) offset = model::corotation<S, 6>(state.stress, increment_.spin);

    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6> jacobian(free_count_, free_count_);
    model::Mandel<S> trial = strain_rate_;
    bool converged = false;
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      const S size_of_trial = model::norm_of<S, 6>(trial);
      const model::Mandel<S> stress_rate =
          law_.stiffness_times(at, trial) - e_m * (viscous + size_of_trial * C_1) + offset;
      const double hypoplastic = model::value_of(C_1) / model::value_of(size_of_trial);
      const model::Mandel<double> plain_trial = model::plain<S, 6>(trial);
      for (int i = 0; i < free_count_; ++i) {
        const auto condition = increment_.condition.row(free_component(i));
        const double along_e_m = condition.dot(plain_e_m) * hypoplastic;
        for (int j = 0; j < free_count_; ++j) {
          const int column = free_component(j);
          jacobian(i, j) = condition.dot(stiffness.col(column)) - along_e_m * plain_trial[column];
        }
      }
      const auto inverse = jacobian.partialPivLu().inverse().eval();
      std::array<S, 6> residual;
      for (int i = 0; i < free_count_; ++i) {
        const int row = free_component(i);
        S sum = -increment_.stress_rate[row];
        for (int j = 0; j < 6; ++j) {
          if (increment_.condition(row, j) != 0.0) sum += stress_rate[j] * increment_.condition(row, j);
        }
        residual[static_cast<std::size_t>(i)] = sum;
      }
      double change = 0.0;
      for (int i = 0; i < free_count_; ++i) {
        S step(0.0);
        for (int j = 0; j < free_count_; ++j) step += residual[static_cast<std::size_t>(j)] * inverse(i, j);
        if (!std::isfinite(model::value_of(step))) return false;
        change = std::max(change, std::abs(model::value_of(step)));
        trial[free_component(i)] -= step;
      }
      double size = model::value_of(viscous);
      for (int i = 0; i < 6; ++i) size = std::max(size, std::abs(model::value_of(trial[i])));
      if (converged) {
        strain_rate_ = trial;
        norm_ = model::norm_of<S, 6>(trial);
        return true;
      }
      converged = change <= kSmallStep * size;
    }
    return false;
  }

  [[nodiscard]] int free_component(int i) const { return free_[static_cast<std::size_t>(i)]; }

  const model::Law<P>& law_;
  const Increment<S>& increment_;
  model::Mandel<S> strain_rate_;
  S norm_;
  std::array<int, 6> free_{};
  int free_count_ = 0;
  bool rotates_ = false;
};

}  // namespace isotach::integrators
