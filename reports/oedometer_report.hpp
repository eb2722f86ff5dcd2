// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The report of fit-oedometer.
#pragma once

#include <string_view>

#include "calibration/fit_oedometer.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page oedometer_report(const RunInfo& run, const datasets::Study& study,
                                    const calibration::OedometerFit& fit);

/// Its sections behind the summary: curves, start values, residuals, uncertainty, search, robustness, data
/// and definitions. What a fit has not, as one without assessment, is left out. `prefix` stands before their
/// headings.
void add_oedometer_sections(Page& page, const datasets::Study& study, const calibration::OedometerFit& fit,
                            std::string_view prefix = {});

}  // namespace isotach::reports
