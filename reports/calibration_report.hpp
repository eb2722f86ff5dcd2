// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The report of the main job: the chain of fits, then the report of each.
#pragma once

#include "calibration/calibrate.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page calibration_report(const RunInfo& run, const datasets::Study& study,
                                      const calibration::Calibration& calibration);

}  // namespace isotach::reports
