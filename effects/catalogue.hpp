// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The list of all effects, and how files name their parameters.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "effects/effect.hpp"

namespace isotach::effects {

/// All effects, in the order in which files and reports list them.
[[nodiscard]] std::span<const Effect* const> catalogue();

/// The effect of that name; null where there is none.
[[nodiscard]] const Effect* find_effect(std::string_view name);

/// One parameter of one effect.
struct ParameterRef {
  const Effect* effect;  ///< of the catalogue
  std::size_t index;     ///< among its parameters

  [[nodiscard]] const EffectParameter& info() const { return effect->parameters[index]; }
  [[nodiscard]] std::string name() const;  ///< "ring_friction.mu"
  friend bool operator==(const ParameterRef&, const ParameterRef&) = default;
};

/// The parameter that "ring_friction.mu" names, if there is one.
[[nodiscard]] std::optional<ParameterRef> find_parameter(std::string_view name);

/// Every parameter of the effects of one kind of test that a fit can move, as "ring_friction.mu, ...".
[[nodiscard]] std::string searched_names(TestKind test);

}  // namespace isotach::effects
