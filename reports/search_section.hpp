// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How an oedometer fit's answer was found: routes, global searches, and fits from other starts.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// The different answers of the multi-start with their costs and values, the best first.
[[nodiscard]] Table cluster_table(const calibration::FitResult& result,
                                  const calibration::MultiStart& multi_start);

void add_search(Page& page, const calibration::OedometerFit& fit);

}  // namespace isotach::reports
