// Copyright Isotach contributors. SPDX-License-Identifier: Apache-2.0
// The report of fit-oedometer.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page oedometer_report(const RunInfo& run, const datasets::Study& study,
                                    const calibration::OedometerFit& fit);

/// The verdicts and facts of its summary, for the summary of a page.
void add_oedometer_summary(Page& page, const datasets::Study& study, const calibration::OedometerFit& fit);
/// Its sections.
void add_oedometer_sections(Page& page, const datasets::Study& study, const calibration::OedometerFit& fit);

}  // namespace isotach::reports
