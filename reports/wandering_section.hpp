// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One slot of the model at a time let wander: what each would have to do, as table, figures and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "discovery/wandering.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// What the slot that stands out most would have to do, as a sentence.
[[nodiscard]] std::string wander_words(const discovery::Wandering& wandering);
/// All slots, and the curves of those that stand out most; `words` say what was let wander.
void add_wandering(Page& page, const discovery::Wandering& wandering, const std::string& words);
[[nodiscard]] nlohmann::ordered_json wandering_json(const discovery::Wandering& wandering);

}  // namespace isotach::reports
