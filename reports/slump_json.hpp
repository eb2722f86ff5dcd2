// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One simulated slump as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "mpm/slump.hpp"

namespace isotach::reports {

/// Outlines (time, height, toe), errors, work done, initial state and numerics of a run.
[[nodiscard]] nlohmann::ordered_json slump_json(const mpm::SlumpSetup& setup, const mpm::SlumpResult& result);

/// Largest factor on inertia that the run used.
[[nodiscard]] double largest_inertia_scaling(const mpm::SlumpResult& result);

}  // namespace isotach::reports
