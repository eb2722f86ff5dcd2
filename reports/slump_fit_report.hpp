// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The report of fit-slump.
#pragma once

#include "calibration/fit_slump.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page slump_fit_report(const RunInfo& run, const datasets::Study& study,
                                    const calibration::SlumpFit& fit);

/// Its verdicts but those on parameters, for the summary of a page.
void add_slump_fit_verdicts(Page& page, const calibration::SlumpFit& fit);
/// The facts of its summary.
void add_slump_fit_facts(Page& page, const calibration::SlumpFit& fit);
/// Its section: outlines, uncertainty, search and simulations.
void add_slump_fit_section(Page& page, const datasets::Study& study, const calibration::SlumpFit& fit);

}  // namespace isotach::reports
