// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A constant of the law, or a reading, that is let wander over a test's history: what closes a gap that no
// effect explains.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "model/parameters.hpp"

namespace isotach::experiments {

/// What may wander.
enum class Slot { preconsolidation_pressure, lambda, kappa, I_v, D_r, stress_reading, strain_reading };
inline constexpr std::array kSlots{Slot::preconsolidation_pressure,
                                   Slot::lambda,
                                   Slot::kappa,
                                   Slot::I_v,
                                   Slot::D_r,
                                   Slot::stress_reading,
                                   Slot::strain_reading};

struct SlotInfo {
  std::string_view name;
  std::string_view meaning;  ///< of a change, in words
  /// The change is that of a logarithm; of the strain read it is engineering strain since the start.
  bool logarithmic;
  double plausible;  ///< size of a change that a test may well show: the scale of what is looked for
};
[[nodiscard]] const SlotInfo& info_of(Slot slot);

/// A slot's change at the start and at the end of each step of a history; in a step a constant of the law is
/// that of the step's end.
template <class S>
struct Wander {
  Slot slot;
  std::span<const S> change;
};

/// Parameters with a slot of the law changed.
template <class S>
[[nodiscard]] model::Parameters<S> changed(const model::Parameters<S>& parameters, Slot slot,
                                           const S& change) {
  using model::ParameterId;
  using std::exp;
  model::ParameterValues<S> values = parameters.values();
  switch (slot) {
    case Slot::preconsolidation_pressure:  // ln p_B holds ln(1 + e100)/lambda
      values[ParameterId::e100] = (1.0 + parameters.e100()) * exp(parameters.lambda() * change) - 1.0;
      break;
    case Slot::lambda:
      values[ParameterId::lambda] = parameters.lambda() * exp(change);
      break;
    case Slot::kappa:
      values[ParameterId::kappa] = parameters.kappa() * exp(change);
      break;
    case Slot::I_v:
      values[ParameterId::I_v] = parameters.I_v() * exp(change);
      break;
    case Slot::D_r:
      values[ParameterId::D_r] = parameters.D_r() * exp(change);
      break;
    case Slot::stress_reading:
    case Slot::strain_reading:
      break;
  }
  return *model::Parameters<S>::create(values);
}

}  // namespace isotach::experiments
