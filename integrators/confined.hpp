// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Confined compression, no strain but axial: the law's rate in two components, driven by strain or by stress.
#pragma once

#include "integrators/fellin_ostermann.hpp"

namespace isotach::integrators {

/// Axial loading at a constant rate for `duration`; tension positive.
template <class S>
struct ConfinedIncrement {
  bool stress_controlled = false;
  S axial_rate = S(0.0);  ///< of strain (1/s), or of effective stress (Pa/s)
  double duration = 0.0;  ///< s, >= 0
};

/// Right-hand side dy/dt = F(y) of confined compression. S is the scalar of parameters and state. Refers to
/// the law, which must outlive it.
template <class S, model::Fabric K>
class ConfinedRate {
 public:
  using State = model::State<S, model::kAxial, K>;
  using Rate = model::StateRate<S, model::kAxial, K>;

  ConfinedRate(const model::Law<S>& law, const ConfinedIncrement<S>& increment)
      : law_(law), increment_(increment) {}

  /// False where the state is outside the law's domain, or no axial strain rate gives the stress rate.
  [[nodiscard]] bool operator()(const State& state, Rate& rate) {
    if (!law_.in_domain(state)) return false;
    const auto at = law_.measures(state);
    const S viscous = law_.viscous_rate(at.equivalent_pressure, state.void_ratio);
    const Tensor flow = law_.stiffness_times(at, at.m);
    Tensor axial = Tensor::Constant(S(0.0));
    axial[0] = S(1.0);
    const Tensor stiffness = law_.stiffness_times(at, axial);
    S strain_rate = increment_.axial_rate;
    if (increment_.stress_controlled) {
      // The axial component of (1a), with E11 = (E : 1_a)_a, M = (E : m)_a and the strain rate d of sign s,
      //   stress rate = E11 d - M (|D_vis| + C_1 s d),
      // is linear in d once its sign is known, which is that of the stress rate plus M |D_vis|.
      const S driving = increment_.axial_rate + flow[0] * viscous;
      const bool compression = model::value_of(driving) < 0.0;
      const S hypoplastic = flow[0] * law_.parameters().C_1();
      const S slope = compression ? S(stiffness[0] + hypoplastic) : S(stiffness[0] - hypoplastic);
      if (!(model::value_of(slope) > 0.0)) return false;
      strain_rate = driving / slope;
    }
    const S size = model::value_of(strain_rate) < 0.0 ? S(-strain_rate) : strain_rate;
    const S irreversible = viscous + size * law_.parameters().C_1();
    for (int i = 0; i < model::kAxial; ++i) {
      rate.stress[i] = stiffness[i] * strain_rate - flow[i] * irreversible;
    }
    rate.void_ratio = (1.0 + state.void_ratio) * strain_rate;
    if constexpr (K == model::Fabric::omega) {
      rate.omega = model::rotation_rate<S, S, model::kAxial>(law_.parameters().C_2(), law_.parameters().C_3(),
                                                             at.ratio, state.omega, viscous);
    }
    relaxation_ = relaxation_rate(state, at.m, flow, model::value_of(viscous));
    return true;
  }

  [[nodiscard]] bool contains(const State& state) const { return law_.in_domain(state); }

  /// The longest substep (s) that damps what viscous flow damps, at the state computed last: the method's
  /// factor 1 - z + z^2/2 of a mode that decays as exp(-z) over it is below one up to z = 2.
  [[nodiscard]] double largest_substep() const {
    constexpr double kDamped = 1.5;
    return relaxation_ > 0.0 ? kDamped / relaxation_ : HUGE_VAL;
  }

 private:
  using Tensor = model::Mandel<S, model::kAxial>;

  /// Rate (1/s) at which a deviation of p_B+ from its course decays: with p_B+ of degree one in T its
  /// gradient along m is p_B+/(m : T), so that D_vis ~ p_B+^(1/I_v) makes it |D_vis| (m : E : m)/(I_v m : T).
  double relaxation_rate(const State& state, const Tensor& m, const Tensor& flow, double viscous) const {
    using model::value_of;
    double along = 0.0;
    double stiffness = 0.0;
    for (int i = 0; i < model::kAxial; ++i) {
      along += value_of(m[i]) * value_of(state.stress[i]);
      stiffness += value_of(m[i]) * value_of(flow[i]);
    }
    return along > 0.0 ? viscous * stiffness / (value_of(law_.parameters().I_v()) * along) : 0.0;
  }

  const model::Law<S>& law_;
  const ConfinedIncrement<S>& increment_;
  double relaxation_ = 0.0;
};

/// Fellin-Ostermann over one increment of confined compression; advances `state` and returns what it cost.
/// `substep` (s; 0: the duration) is the first to try and becomes a good next one. On failure `state` is
/// unchanged.
template <class S, model::Fabric K>
[[nodiscard]] tl::expected<Statistics, Failure> integrate_confined(const model::Law<S>& law,
                                                                   model::State<S, model::kAxial, K>& state,
                                                                   const ConfinedIncrement<S>& increment,
                                                                   const Tolerance& tolerance,
                                                                   double& substep) {
  using State = model::State<S, model::kAxial, K>;
  ConfinedRate<S, K> rate(law, increment);
  auto substeps = fellin_ostermann_substeps(
      state, increment.duration, tolerance, substep,
      [&rate](const State& y, model::StateRate<S, model::kAxial, K>& f) { return rate(y, f); },
      [&rate](const State& y) { return rate.contains(y); }, [](double) {},
      [&rate] { return rate.largest_substep(); });
  if (substeps) return *substeps;
  const auto& error = substeps.error();
  return tl::unexpected(Failure{error.kind, error.time,
                                model::general(model::with_omega(model::plain(error.last_state))),
                                error.statistics});
}

}  // namespace isotach::integrators
