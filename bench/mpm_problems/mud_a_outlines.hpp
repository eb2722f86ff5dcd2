// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines of another MPM code (datasets/mud-a) against those of this engine, at parameters fitted to them.
#pragma once

#include <filesystem>

#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// Fits the study's oedometer tests, then its [fit] slump parameters to its slumps, with and without
/// background viscosity, and compares every outline at three cell sizes. datasets::InputError: as
/// datasets::read_study; std::runtime_error where a fit or a run breaks off.
[[nodiscard]] Section mud_a_section(const std::filesystem::path& study);

}  // namespace isotach::bench
