// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The report of one simulated slump.
#pragma once

#include "datasets/slump_file.hpp"
#include "mpm/slump.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

[[nodiscard]] Page slump_report(const RunInfo& run, const datasets::SlumpFile& test,
                                const mpm::SlumpResult& result);

}  // namespace isotach::reports
