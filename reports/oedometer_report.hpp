// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The report of fit-oedometer.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page oedometer_report(const RunInfo& run, const datasets::Study& study,
                                    const calibration::OedometerFit& fit);

/// Its verdicts but those on parameters, for the summary of a page.
void add_oedometer_verdicts(Page& page, const calibration::OedometerFit& fit);
/// Its section: curves, residuals, uncertainty, search, gauge and data.
void add_oedometer_section(Page& page, const datasets::Study& study, const calibration::OedometerFit& fit);

}  // namespace isotach::reports
