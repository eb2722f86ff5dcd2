// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A constant of the law or a reading of oedometer tests is let wander, over the time of each test or over
// stress.
#pragma once

#include "discovery/candidate.hpp"
#include "discovery/wandering.hpp"

namespace isotach::discovery {

/// Over the time of each test (s), a function for each.
inline constexpr WanderAxis kOverTime{"time", "the time of each test", "time (h)", 3600.0, false};
/// Over the stress read (Pa), one function for all tests; knots by its logarithm.
inline constexpr WanderAxis kOverStress{"stress", "stress", "axial stress (kPa)", 1e3, true};

/// Lets each slot wander on top of `model`, by `weights` (of the fitted tests, as NoiseFit's).
[[nodiscard]] tl::expected<Wandering, calibration::FitFailure> let_wander(
    const datasets::Study& study, const Candidate& model,
    const std::vector<calibration::ExperimentWeights>& weights, int threads);

}  // namespace isotach::discovery
