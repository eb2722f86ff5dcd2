// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a discovery found in slump tests: sections of a page and an object of result.json.
#pragma once

#include <nlohmann/json.hpp>

#include "discovery/slump_discovery.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// The verdict among those of the page, and a section with where, what and how sure.
void add_slump_discovery(Page& page, const discovery::SlumpDiscovery& found);

/// Verdict, effects, gap, disagreement, conditions, trials, scores, next test.
[[nodiscard]] nlohmann::ordered_json discovery_json(const discovery::SlumpDiscovery& found);

}  // namespace isotach::reports
