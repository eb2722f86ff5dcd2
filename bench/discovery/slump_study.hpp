// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Slump studies with a hidden effect: what the benchmark gives to discovery.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "bench/discovery/outline_part.hpp"
#include "discovery/slump_discovery.hpp"

namespace isotach::bench {

/// One study that is to be made.
struct SlumpCase {
  std::size_t number;
  const effects::Effect* effect;  ///< hidden; null where nothing is
  double visibility;              ///< signal to noise after projection; 0 where nothing is hidden
  double noise;                   ///< m, standard deviation of an outline's points
};

/// Six rounds of all slump effects of the catalogue and two studies with nothing hidden: visibilities of 5,
/// 10 and 30 and noise of 0.5, 1 and 2 mm, all cells of which are equally full over the effects.
[[nodiscard]] std::vector<SlumpCase> slump_plan();

struct MadeSlumpStudy {
  datasets::Study study;
  discovery::MaterialKnowledge knowledge;  ///< as oedometer tests would give it
  double amplitude = 0.0;                  ///< of the hidden effect, SI
  double visibility = 0.0;
  bool reached = true;  ///< an admissible amplitude shows as asked
  std::optional<OutlinePart> part =
      std::nullopt;  ///< where what is hidden shows most, of what the base does not take up
};

/// The case's study, the same for the same seed. Errors say what could not be simulated.
[[nodiscard]] tl::expected<MadeSlumpStudy, std::string> make_slump_study(const SlumpCase& one,
                                                                         std::uint64_t seed);

}  // namespace isotach::bench
