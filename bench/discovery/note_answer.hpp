// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What discovery answered, of oedometer tests or of slumps, written into a record.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench/discovery/record.hpp"
#include "effects/effect.hpp"

namespace isotach::bench {

/// A record whose study has not been tried: what is found out of it is NaN.
[[nodiscard]] inline Record blank_record(std::size_t number, std::uint64_t seed) {
  Record record;
  record.number = number;
  record.seed = seed;
  record.gap_after = record.held_out_after = record.amplitude = record.lower = record.upper =
      std::numeric_limits<double>::quiet_NaN();
  return record;
}

[[nodiscard]] inline std::vector<std::string> names_of(const std::vector<const effects::Effect*>& added) {
  std::vector<std::string> names;
  for (const effects::Effect* effect : added) names.emplace_back(effect->name);
  std::sort(names.begin(), names.end());
  return names;
}

/// All but the place and the amplitude. `Found` is a Discovery or a SlumpDiscovery.
template <class Found>
void note_answer(const Found& found, Record& record) {
  record.verdict = name_of(found.verdict);
  record.p_value = found.p_value;
  record.gap_before = found.base.gap.fitted;
  record.held_out_before = found.base.gap.held_out;
  if (!found.trials.empty()) record.first = names_of(found.trials.front().candidate.added);
  for (const std::size_t k : found.equivalent) {
    record.equivalent.push_back(names_of(found.trials[k].candidate.added));
  }
  for (const auto& condition : found.conditions) {
    if (!condition.holds) record.refused.push_back(condition.text);
  }
  if (!found.chosen) return;
  const auto& named = found.trials[*found.chosen];
  record.named = names_of(named.candidate.added);
  record.gap_after = named.gap.fitted;
  record.held_out_after = named.gap.held_out;
}

}  // namespace isotach::bench
