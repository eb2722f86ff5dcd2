// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a discovery found: the page and result.json.
#pragma once

#include <nlohmann/json.hpp>

#include "discovery/discover.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page discovery_report(const RunInfo& run, const datasets::Study& study,
                                    const discovery::Discovery& found);

/// The verdict of a discovery among those of another report, and a section on it.
void add_discovery(Page& page, const discovery::Discovery& found);

/// Verdict, effects, gap, disagreement, conditions, trials, next test.
[[nodiscard]] nlohmann::ordered_json discovery_json(const discovery::Discovery& found);

/// Under "oedometer" where the study has slump tests too, which are not looked at.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                                                 const discovery::Discovery& found);

}  // namespace isotach::reports
