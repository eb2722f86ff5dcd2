// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A specimen with effects: its state, what a step of the history changes, and what stays the same over a
// test.
#pragma once

#include <numbers>

#include "experiments/instrument.hpp"
#include "model/law_terms.hpp"

namespace isotach::experiments::detail {

/// The specimen and what effects make it remember, within one step of the history.
template <class S, model::Fabric K>
struct EffectsState {
  model::State<S, model::kAxial, K> soil;
  S structure;           ///< chi (-)
  S held_strain;         ///< viscous strain (-) since a hold began
  double elapsed = 0.0;  ///< s since the step began
};

template <class S, model::Fabric K>
struct EffectsStateRate {
  model::StateRate<S, model::kAxial, K> soil;
  S structure;    ///< 1/s
  S held_strain;  ///< 1/s
};

/// What changes from step to step only. Compression positive.
template <class S>
struct EffectsStep {
  bool stress_controlled = false;
  S rate = S(0.0);                ///< of the measured logarithmic strain (1/s), or of the true stress (Pa/s)
  S stress = S(0.0);              ///< true stress as the step begins (Pa); where stress is controlled
  double direction = 1.0;         ///< +1 loading, -1 unloading: the one last commanded
  bool held = false;              ///< nothing is commanded to move
  double temperature = 0.0;       ///< as the step begins (deg C)
  double temperature_rate = 0.0;  ///< K/s
  S compression = S(0.0);         ///< x as the step before ended (1/s, logarithmic)
  S void_ratio_at_reversal = S(0.0);
  S largest_load = S(0.0);  ///< G so far (Pa)
};

/// A specimen's geometry: engineering strain from the law's void ratio.
template <class S>
struct StrainOf {
  S void_ratio_at_start;
  double strain_at_start;

  [[nodiscard]] S operator()(const S& void_ratio) const {
    return 1.0 - (1.0 + void_ratio) / (1.0 + void_ratio_at_start) * (1.0 - strain_at_start);
  }
  /// d strain of a change of void ratio, without its sign.
  [[nodiscard]] S size(const S& change_of_void_ratio) const {
    return change_of_void_ratio * ((1.0 - strain_at_start) / (1.0 + void_ratio_at_start));
  }
};

/// All that stays the same over a test, but for what is let wander.
template <class S>
struct EffectsModel {
  model::Law<S> law;
  model::LawTerms<S> terms;
  S reference_temperature;  ///< deg C; where there is a term of temperature
  Instrument<S> instrument;
  StrainOf<S> strain_of;
  S given_at_start = S(0.0);  ///< strain of what gives in series, under the load at the start

  /// What the ring takes over the radial stress.
  [[nodiscard]] S friction_ratio(const S& void_ratio, double direction) const {
    return instrument.friction_ratio(strain_of(void_ratio), direction);
  }
  /// The load G (Pa) of a specimen.
  template <model::Fabric K>
  [[nodiscard]] S load(const model::State<S, model::kAxial, K>& soil, double direction) const {
    return -soil.stress[0] -
           friction_ratio(soil.void_ratio, direction) * soil.stress[1] * (1.0 / std::numbers::sqrt2);
  }
  /// The strain that is measured: the specimen's, and what gives in series since the start.
  [[nodiscard]] S measured_strain(const S& void_ratio, const S& load, const S& largest) const {
    const S strain = strain_of(void_ratio);
    return instrument.gives() ? S(strain + (instrument.given_strain(load, largest) - given_at_start))
                              : strain;
  }
};

}  // namespace isotach::experiments::detail
