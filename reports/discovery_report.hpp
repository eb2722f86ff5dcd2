// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a discovery found: the page and result.json.
#pragma once

#include <nlohmann/json.hpp>

#include "discovery/discover.hpp"
#include "discovery/slump_discovery.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// What was found in the tests of a study, of either kind that it has.
struct Discoveries {
  std::optional<discovery::Discovery> oedometer;
  std::optional<discovery::SlumpDiscovery> slump;
};

[[nodiscard]] Page discovery_report(const RunInfo& run, const datasets::Study& study,
                                    const Discoveries& found);

/// The verdict of a discovery among those of another report, and a section on it.
void add_discovery(Page& page, const discovery::Discovery& found);

/// Verdict, effects, gap, disagreement, conditions, trials, next test.
[[nodiscard]] nlohmann::ordered_json discovery_json(const discovery::Discovery& found);

/// Under "oedometer" and "slump" where the study has tests of both kinds; null for those not looked at.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                                                 const Discoveries& found);

}  // namespace isotach::reports
