// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Terms that the law may have beyond its equations: how each alters p_B, I_v, D_r or the stiffness.
#pragma once

#include <cmath>
#include <optional>

#include "model/law.hpp"

namespace isotach::model {

/// What the terms know of the past of a material point, and of what surrounds it.
template <class S>
struct LawHistory {
  S structure = S(1.0);           ///< chi (-), what is left of the structure, 1 at the start
  S held_strain = S(0.0);         ///< viscous strain (norm, -) since a hold began; 0 where nothing is held
  S since_reversal = S(0.0);      ///< |strain| (-) since the direction of strain turned
  S temperature_excess = S(0.0);  ///< theta - theta_0 (K)
};

/// The terms; one that is absent leaves the law as it is, and so does each at zero of its first number.
/// docs/effects.md has their sources.
template <class S>
struct LawTerms {
  /// p_B (1 + r chi), dchi/dt = -k |D_vis| chi.
  struct Structure {
    S r;  ///< (-), >= 0
    S k;  ///< (-), >= 0
  };
  /// I_v (1 + b tanh(ln(|D|/D_ref)/3)).
  struct RateDependence {
    S b;      ///< (-), within (-1, 1)
    S D_ref;  ///< 1/s, > 0
  };
  /// kappa/(1 + m exp(-|eps - eps_rev|/eps_r)).
  struct SmallStrain {
    S m;      ///< (-), >= 0
    S eps_r;  ///< (-), > 0
  };

  std::optional<Structure> structure;
  std::optional<S> temperature;  ///< a (1/K) of p_B exp(-a (theta - theta_0))
  std::optional<RateDependence> rate_dependence;
  std::optional<SmallStrain> small_strain;
  std::optional<S> delayed_creep;  ///< c (-) of D_r exp(-c eps_creep)

  /// ln(p_B / 1 Pa) at void ratio e.
  [[nodiscard]] S log_preconsolidation_pressure(const Law<S>& law, const S& void_ratio,
                                                const LawHistory<S>& history) const {
    using std::log;
    S result = law.log_preconsolidation_pressure(void_ratio);
    if (structure) result += log(1.0 + structure->r * history.structure);
    if (temperature) result -= *temperature * history.temperature_excess;
    return result;
  }

  /// Factor on the stiffness (-), kappa of the law over the present one.
  [[nodiscard]] S stiffness_factor(const LawHistory<S>& history) const {
    using std::exp;
    if (!small_strain) return S(1.0);
    return 1.0 + small_strain->m * exp(-history.since_reversal / small_strain->eps_r);
  }

  /// The present D_r (1/s).
  [[nodiscard]] S reference_rate(const Law<S>& law, const LawHistory<S>& history) const {
    using std::exp;
    const S D_r = law.parameters().D_r();
    return delayed_creep ? S(D_r * exp(-*delayed_creep * history.held_strain)) : D_r;
  }

  /// The present I_v (-), of a strain rate |D| (1/s).
  [[nodiscard]] S viscosity_index(const Law<S>& law, const S& strain_rate_norm) const {
    using std::exp;
    using std::log;
    const S I_v = law.parameters().I_v();
    if (!rate_dependence) return I_v;
    // tanh(ln(x)/3) = (x^(2/3) - 1)/(x^(2/3) + 1), whose limit at rest is -1
    constexpr double kRest = 1e-150;  // 1/s; as in norm_of
    const S power = exp((2.0 / 3.0) * log((strain_rate_norm + kRest) / rate_dependence->D_ref));
    return I_v * (1.0 + rate_dependence->b * ((power - 1.0) / (power + 1.0)));
  }

  /// d chi/dt (1/s).
  [[nodiscard]] S structure_rate(const LawHistory<S>& history, const S& viscous_rate) const {
    return structure ? S(-structure->k * viscous_rate * history.structure) : S(0.0);
  }
};

}  // namespace isotach::model
