// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One increment as a system of ordinary differential equations of plain numbers, with its exact Jacobian.
#pragma once

#include <ceres/jet.h>

#include <array>
#include <cstddef>

#include "integrators/loading_rate.hpp"
#include "integrators/result.hpp"

namespace isotach::integrators {

/// dy/dt = f(y) over an increment. The unknowns y are the stress in units of `stress_scale` (Pa), the void
/// ratio, Omega where the state has it, and last the strain since the start, on which f does not depend.
/// Refers to the law and the increment given, which must outlive it.
template <model::Fabric K>
class IncrementSystem {
 public:
  static constexpr int kState = K == model::Fabric::omega ? 13 : 7;  ///< unknowns that f depends on
  static constexpr int kStrain = kState;                             ///< index of the first of the strain
  static constexpr int kUnknowns = kState + 6;
  using State = model::State<double, model::kGeneral, K>;
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
  /// Rows: unknowns; columns: those of the state.
  using Jacobian = Eigen::Matrix<double, kUnknowns, kState>;

  IncrementSystem(const model::Law<double>& law, const Increment<double>& increment, double stress_scale)
      : stress_scale_(stress_scale),
        jet_increment_(increment.cast<Jet>()),
        rate_(law, increment),
        jet_rate_(law, jet_increment_) {}

  IncrementSystem(const IncrementSystem&) = delete;  // the rates refer to members
  IncrementSystem& operator=(const IncrementSystem&) = delete;

  [[nodiscard]] double stress_scale() const { return stress_scale_; }
  [[nodiscard]] bool contains(const State& state) const { return rate_.contains(state); }

  /// Hands the unknowns, or their rates, to `to(index, value)`: those of a State with the strain, or of a
  /// StateRate with the strain rate.
  template <class S, class StateOrRate, class To>
  void spread(const StateOrRate& of, const model::Mandel<S>& strain, To&& to) const {
    for (int i = 0; i < 6; ++i) {
      to(i, S(of.stress[i] / stress_scale_));
      if constexpr (K == model::Fabric::omega) to(7 + i, of.omega[i]);
      to(kStrain + i, strain[i]);
    }
    to(6, of.void_ratio);
  }

  /// The unknowns at the start.
  template <class To>
  void start(const State& state, To& y) const {
    const model::Mandel<double> strain = model::Mandel<double>::Zero();
    spread(state, strain, [&y](int i, double value) { y[i] = value; });
  }

  /// The state at unknowns y, which is indexed.
  template <class S, class From>
  [[nodiscard]] model::State<S, model::kGeneral, K> state(const From& y) const {
    model::State<S, model::kGeneral, K> s;
    for (int i = 0; i < 6; ++i) {
      s.stress[i] = y[i] * stress_scale_;
      if constexpr (K == model::Fabric::omega) s.omega[i] = y[7 + i];
    }
    s.void_ratio = y[6];
    return s;
  }

  /// The strain at unknowns y.
  template <class From>
  [[nodiscard]] model::Mandel<double> strain(const From& y) const {
    model::Mandel<double> result;
    for (int i = 0; i < 6; ++i) result[i] = y[kStrain + i];
    return result;
  }

  /// f(y); false where y is outside the law's domain or the free strain rates cannot be found.
  template <class From, class To>
  [[nodiscard]] bool rate(const From& y, To& dy) {
    ++evaluations_;
    typename LoadingRate<double, double, K>::Rate f;
    if (!rate_(state<double>(y), f)) return false;
    spread(f, rate_.strain_rate(), [&dy](int i, double value) { dy[i] = value; });
    return true;
  }

  /// f(y) and df/dy; false as above.
  template <class From>
  [[nodiscard]] bool rate_and_jacobian(const From& y, Unknowns& dy, Jacobian& jacobian) {
    ++jacobians_;
    std::array<Jet, kState> jets;
    for (int i = 0; i < kState; ++i) jets[static_cast<std::size_t>(i)] = Jet(y[i], i);
    typename LoadingRate<Jet, double, K>::Rate f;
    if (!jet_rate_(state<Jet>(jets.data()), f)) return false;
    spread(f, jet_rate_.strain_rate(), [&](int i, const Jet& value) {
      dy[i] = value.a;
      jacobian.row(i) = value.v.transpose();
    });
    return true;
  }

  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] long jacobians() const { return jacobians_; }

 private:
  using Jet = ceres::Jet<double, kState>;

  double stress_scale_;
  Increment<Jet> jet_increment_;
  LoadingRate<double, double, K> rate_;
  LoadingRate<Jet, double, K> jet_rate_;
  long evaluations_ = 0;
  long jacobians_ = 0;
};

}  // namespace isotach::integrators
