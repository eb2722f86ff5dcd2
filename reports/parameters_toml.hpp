// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// parameters.toml: the answer of a fit as the next study's [material].
#pragma once

#include <string>

#include "calibration/calibrate.hpp"
#include "reports/discovery_report.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// A [material] table, and where the oedometer fit has effects an [effects] table, with every parameter under
/// its key and in its key's unit, and comments that say where each came from. Read back it gives the same
/// doubles: each number is the shortest decimal that does so.
[[nodiscard]] std::string parameters_toml(const RunInfo& run, const calibration::OedometerFit& fit);
[[nodiscard]] std::string parameters_toml(const RunInfo& run, const calibration::SlumpFit& fit);
[[nodiscard]] std::string parameters_toml(const RunInfo& run, const calibration::Calibration& calibration);
/// The material by the oedometer tests, where there are any; the effects of both kinds of test.
[[nodiscard]] std::string parameters_toml(const RunInfo& run, const Discoveries& found);

}  // namespace isotach::reports
