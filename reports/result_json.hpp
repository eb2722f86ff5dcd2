// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// result.json of every command, as values.
#pragma once

#include <nlohmann/json.hpp>

#include "calibration/calibrate.hpp"
#include "datasets/slump_file.hpp"
#include "datasets/study.hpp"
#include "mpm/slump.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

// Keys carry their units, as in the other files; a parameter has its unit
// beside its value, which is that of its key in a [material] table. Numbers
// that do not exist are null. All of these start with the head "command",
// "version", "status", "seconds", "warnings"; status is "ok".

/// `isotach fit-oedometer`.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                                                 const calibration::OedometerFit& fit);
/// `isotach fit-slump`.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                                                 const calibration::SlumpFit& fit);
/// `isotach calibrate`: "fit_oedometer" and "fit_slump" are what those commands
/// write, without head. "parameters" has each parameter from the fit that moved
/// it.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                                                 const calibration::Calibration& calibration);
/// `isotach slump`.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::SlumpFile& test,
                                                 const mpm::SlumpResult& result);

/// A run that the numerics ended: status "failed" (or "interrupted") and
/// "failure": what, and where known when and where ("time_s", "r_mm", "z_mm").
[[nodiscard]] nlohmann::ordered_json failure_json(const RunInfo& run, const calibration::FitFailure& failure);
[[nodiscard]] nlohmann::ordered_json failure_json(const RunInfo& run, const mpm::SlumpFailure& failure);

}  // namespace isotach::reports
