// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A benchmark study as discovery gets it, and what only its maker knows.
#pragma once

#include <cstdint>
#include <functional>

#include "bench/discovery/hidden.hpp"
#include "bench/discovery/plan.hpp"

namespace isotach::bench {

/// An amplitude that shows as plainly as asked, or the largest that may be.
struct Sought {
  double amplitude;
  double visibility;  ///< there
  bool reached;       ///< within kVisibilityTolerance of what was asked
};
inline constexpr double kVisibilityTolerance = 0.02;

/// Seeks `wanted` > 0 between zero and `most` (either sign) from `typical` (of the same sign). `visibility`
/// of an amplitude, nothing where it cannot be had, grows with it in the main.
[[nodiscard]] Sought seek_visibility(const std::function<std::optional<double>(double)>& visibility,
                                     double typical, double most, double wanted);

struct MadeStudy {
  datasets::Study study;
  model::Parameters<double> truth;
  Hidden hidden;
  double visibility;  ///< of the least visible hidden effect; 0 where nothing is hidden
  bool reached;       ///< as asked
  Left left;          ///< by all that is hidden, of the fitted tests
  /// What the hidden leaves (sigma) once the best other effect of the catalogue, with its shapes, may be used
  /// beside the base; linearised at zero of that effect. 0 where nothing is hidden.
  double beside_another;
};

/// Makes the study of a case: the seed mud with parameters within +-25 %, shapes of hidden effects within a
/// factor of two of their typical ones. An error says what could not be made.
[[nodiscard]] tl::expected<MadeStudy, std::string> make_study(const Case& one, std::uint64_t seed);

}  // namespace isotach::bench
