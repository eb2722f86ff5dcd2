// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Several simulated slumps side by side: what was varied, and what it changes.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "reports/compared_slump.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// Inputs that differ between the slumps, outlines together at each output time that all of them have (at
/// their last where they share none), heights and toes, budgets, how far apart they are and how strong; those
/// that failed with place and time. At least one must have a result.
[[nodiscard]] Page slump_comparison_report(const RunInfo& run, std::span<const ComparedSlump> slumps);

/// Under "slumps", for each what result.json of a single run has, its name, file, status and strengths; under
/// "differences", how far apart they are. The status of the whole is "failed" where one is.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, std::span<const ComparedSlump> slumps);

}  // namespace isotach::reports
