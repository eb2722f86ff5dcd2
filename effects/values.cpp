// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "effects/values.hpp"

#include <fmt/format.h>

namespace isotach::effects {

std::string EffectError::message() const {
  return fmt::format("{} = {} is not admissible; accepted: {}", parameter.name(), value, accepted);
}

Chosen<double> with_amplitude(const Effect& effect, double amplitude) {
  Chosen<double> chosen{&effect, {}};
  for (std::size_t i = 0; i < effect.parameters.size(); ++i) chosen.si[i] = effect.at_zero(i);
  chosen.si[0] = amplitude;
  return chosen;
}

std::optional<EffectError> check(const std::vector<Chosen<double>>& chosen) {
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Effect& effect = *chosen[k].effect;
    for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
      const EffectParameter& parameter = effect.parameters[i];
      const double si = chosen[k].si[i];
      const bool above = parameter.lower_open ? si > parameter.lower_si() : si >= parameter.lower_si();
      if (above && si <= parameter.upper_si()) continue;
      return EffectError{{&effect, i},
                         si / parameter.to_si,
                         fmt::format("{} {} and <= {}{}{}", parameter.lower_open ? ">" : ">=",
                                     parameter.lower, parameter.upper, parameter.unit == "-" ? "" : " ",
                                     parameter.unit == "-" ? "" : parameter.unit)};
    }
    for (std::size_t j = 0; j < k; ++j) {
      if (chosen[j].effect != &effect) continue;
      return EffectError{{&effect, 0}, chosen[k].si[0] / effect.parameters[0].to_si, "each effect once"};
    }
  }
  return std::nullopt;
}

}  // namespace isotach::effects
