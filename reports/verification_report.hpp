// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What `isotach verify` writes: report, curves, result.json, and a random path as an element test.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reports/output_directory.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"
#include "verification/verification.hpp"

namespace isotach::reports {

/// Summary, then a section for each study.
[[nodiscard]] Page verification_report(const RunInfo& run, const verification::Verification& result);

/// Curves of every figure as CSV: convergence.csv, random_paths.csv (the distribution),
/// random_paths_worst.csv, tangents.csv, work_precision.csv and cross_check/<path>.csv.
void write_curves(OutputDirectory& output, const verification::Verification& result);

/// Head and "checks": name, integrator, expected, got, tolerance, pass; sampling and seed; the random paths'
/// counts and quantiles. Status "ok" where every check passes, else "failed".
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run,
                                                 const verification::Verification& result);

/// One random path again: how it ended, its error, and its element test file.
[[nodiscard]] Page random_path_report(const RunInfo& run, const verification::Path& path,
                                      const verification::PathRecord& record, double tolerance);
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const verification::Path& path,
                                                 const verification::PathRecord& record, double tolerance);

/// A path whose increments are strain-driven as the text of an element test file.
[[nodiscard]] std::string element_toml(const verification::Path& path);

}  // namespace isotach::reports
