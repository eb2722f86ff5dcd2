// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The studies of the benchmark, numbered so that any number of the first ones is spread over all cells.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/discovery/outside.hpp"
#include "bench/discovery/programme.hpp"

namespace isotach::bench {

enum class Kind {
  null,     ///< nothing is hidden
  effect,   ///< one effect of the catalogue
  outside,  ///< something that the catalogue lacks
  deleted,  ///< one effect of the catalogue, which discovery is not given
  pair      ///< two effects of the catalogue at once
};
[[nodiscard]] std::string_view name_of(Kind kind);

inline constexpr std::array kNoiseLevels{0.005, 0.01, 0.02};  ///< of ln stress
inline constexpr std::array kVisibilities{5.0, 10.0, 30.0};   ///< signal-to-noise ratios after projection

/// One study that is to be made.
struct Case {
  std::size_t number;
  Kind kind;
  std::vector<const effects::Effect*> effects;  ///< hidden, of the catalogue
  std::optional<OutsideKind> outside;           ///< hidden, not of the catalogue
  Programme programme;
  double noise;       ///< of kNoiseLevels
  double visibility;  ///< of kVisibilities, of each hidden effect by itself; 0 where nothing is hidden
};

/// All studies: 72 of each oedometer effect of the catalogue, 204 nulls, 36 of each outside effect, 18 of
/// each effect deleted, 48 pairs. In each of these groups all cells of visibility, noise and programme are
/// equally full; the groups are dealt into one another, and each group's studies are in a fixed random order.
[[nodiscard]] std::vector<Case> full_plan();

}  // namespace isotach::bench
