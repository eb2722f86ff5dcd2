// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Test 1 of the seed paper under refinement: cells, points, water's stiffness, tolerance and steps.
#pragma once

#include <vector>

#include "bench/mpm_problems/section.hpp"
#include "mpm/slump.hpp"

namespace isotach::bench {

/// Test 1 of the seed paper (78 mm mould, 140 mm of mud at e = 3.891, raised at 0.06 m/s, smooth wall, rough
/// base), numerics by default but for the cell size (m).
[[nodiscard]] mpm::SlumpSetup seed_test_1(double cell_size, std::vector<double> times);

/// Runs a setup with the seed's mud. std::runtime_error where the run breaks off.
[[nodiscard]] mpm::SlumpResult run_seed_mud(const mpm::SlumpSetup& setup);

[[nodiscard]] Section vhp_slump_section();

}  // namespace isotach::bench
