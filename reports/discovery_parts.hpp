// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What discoveries in oedometer and in slump tests say alike: names, values, gaps, conditions, the next test.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "discovery/candidate.hpp"
#include "discovery/discover.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

using EffectList = std::vector<const effects::Effect*>;

/// "ring_friction (friction of the ring) and gas (...)".
[[nodiscard]] std::string described(const EffectList& added);
/// "name = 0.1, other = 2" of their parameters, in the units of files.
[[nodiscard]] std::string values_of(const EffectList& added, const effects::Values<double>& values);

/// " (name 0.08 to 0.12)" of amplitudes that tests do not exclude, in the units of files; with what ends an
/// interval where that is not the misfit.
[[nodiscard]] std::string intervals_words(const std::vector<discovery::AmplitudeInterval>& amplitudes);

/// Whose gap it is ("the gap of the outlines"), what it is counted in, and what a smoother follows.
struct GapNouns {
  std::string gap;
  std::string noise;
  std::string data;
};
/// A sentence on the gap before and after, beside the best of the wrong and a smoother.
[[nodiscard]] std::string gap_words(const GapNouns& nouns, const discovery::Gap& before,
                                    const discovery::Gap& after, double best_wrong, double smoother);
/// What the next test would do.
[[nodiscard]] std::string next_words(const discovery::NextExperiment& next);

/// Conditions of a name and effects that were not fitted, where there are any.
void add_conditions(Page& page, const std::vector<discovery::Condition>& conditions);
void add_not_tried(Page& page, const std::vector<std::pair<const effects::Effect*, std::string>>& not_tried);

[[nodiscard]] nlohmann::ordered_json names_json(const EffectList& added);
/// {"effect": {"parameter": value in the unit of files}}.
[[nodiscard]] nlohmann::ordered_json values_json(const EffectList& added,
                                                 const effects::Values<double>& values);
/// By effect the amplitude's name, ends (in the unit of files), what ends it, and the level.
[[nodiscard]] nlohmann::ordered_json intervals_json(
    const std::vector<discovery::AmplitudeInterval>& amplitudes);
[[nodiscard]] nlohmann::ordered_json gap_json(const discovery::Gap& before, const discovery::Gap& after,
                                              double best_wrong, double smoother);
[[nodiscard]] nlohmann::ordered_json conditions_json(const std::vector<discovery::Condition>& conditions);
[[nodiscard]] nlohmann::ordered_json next_json(const std::optional<discovery::NextExperiment>& next);

}  // namespace isotach::reports
