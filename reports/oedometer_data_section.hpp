// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What an oedometer fit was made from: tests, specimens, starts, what the readers did, and what was assumed.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "datasets/study.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

void add_oedometer_data(Page& page, const datasets::Study& study, const calibration::OedometerFit& fit);

/// What symbols, units and verdicts of the report mean.
void add_oedometer_definitions(Page& page);

}  // namespace isotach::reports
