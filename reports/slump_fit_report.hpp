// Copyright Isotach contributors. SPDX-License-Identifier: Apache-2.0
// The report of fit-slump.
#pragma once

#include "calibration/fit_slump.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page slump_fit_report(const RunInfo& run, const datasets::Study& study,
                                    const calibration::SlumpFit& fit);

/// The verdicts and facts of its summary, for the summary of a page.
void add_slump_fit_summary(Page& page, const datasets::Study& study, const calibration::SlumpFit& fit);
/// Its sections.
void add_slump_fit_sections(Page& page, const datasets::Study& study, const calibration::SlumpFit& fit);

}  // namespace isotach::reports
