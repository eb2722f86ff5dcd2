// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Slump studies with a hidden effect: what the benchmark gives to discovery.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "discovery/slump_discovery.hpp"

namespace isotach::bench {

/// One study that is to be made.
struct SlumpCase {
  std::size_t number;
  const effects::Effect* effect;  ///< hidden; null where nothing is
  double visibility;              ///< signal to noise after projection; 0 where nothing is hidden
};

/// Five rounds of all slump effects of the catalogue and two studies with nothing hidden, visibilities 10 and
/// 30 by turns.
[[nodiscard]] std::vector<SlumpCase> slump_plan();

struct MadeSlumpStudy {
  datasets::Study study;
  discovery::MaterialKnowledge knowledge;  ///< as oedometer tests would give it
  double amplitude = 0.0;                  ///< of the hidden effect, SI
  double visibility = 0.0;
  bool reached = true;  ///< an admissible amplitude shows as asked
};

/// The case's study, the same for the same seed. Errors say what could not be simulated.
[[nodiscard]] tl::expected<MadeSlumpStudy, std::string> make_slump_study(const SlumpCase& one,
                                                                         std::uint64_t seed);

}  // namespace isotach::bench
