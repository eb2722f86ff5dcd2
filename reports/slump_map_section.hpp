// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How well slump tests determine what was fitted to them, and where the fit misses them.
#pragma once

#include "calibration/fit_slump.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// Map of the misfit with its valley, profiles, and what other searches found; nothing without a map.
void add_slump_map(Page& page, const calibration::SlumpFit& fit);

/// The error of the simulations themselves, and how it was measured.
void add_simulation_error(Page& page, const calibration::SimulationError& error);

/// Mean distances by test, time and part of the outline, the largest first.
void add_where_it_fails(Page& page, const calibration::SlumpFit& fit);

}  // namespace isotach::reports
