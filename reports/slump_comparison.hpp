// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Several simulated slumps side by side: what was varied, and what it changes.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "datasets/slump_file.hpp"
#include "mpm/slump.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// A slump file and what came of it.
struct ComparedSlump {
  std::string name;  ///< of its results: unique and safe as a file name
  datasets::SlumpFile test;
  tl::expected<mpm::SlumpResult, mpm::SlumpFailure> result;
};

/// Inputs that differ between the slumps, outlines together at each output time that all of them have (at
/// their last where they share none), heights and toes, budgets; those that failed with place and time. At
/// least one must have a result.
[[nodiscard]] Page slump_comparison_report(const RunInfo& run, std::span<const ComparedSlump> slumps);

/// Under "slumps", for each what result.json of a single run has, its name, file and status. The status of
/// the whole is "failed" where one is.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, std::span<const ComparedSlump> slumps);

}  // namespace isotach::reports
