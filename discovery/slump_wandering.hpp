// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The wall, the base or the strength of the mud in slumps is let wander: a gap that closes when the wall does
// is the mould's, one that closes when strength changes with strain rate the material's.
#pragma once

#include "discovery/slump_candidate.hpp"
#include "discovery/wandering.hpp"

namespace isotach::discovery {

/// Over the time of each test (s), a function for each; knots by its logarithm.
inline constexpr WanderAxis kOverSlumpTime{"time", "the time of each test", "time (s)", 1.0, true};
/// Over the height in the fill that the mud started from, over the fill's; one function for all tests.
inline constexpr WanderAxis kOverFill{"height", "the height in the fill", "height over the fill's (-)", 1.0,
                                      false};
/// Over |D| (1/s), likewise; knots by its logarithm.
inline constexpr WanderAxis kOverRate{"rate", "strain rate", "strain rate |D| (1/s)", 1.0, true};

/// Lets each slot wander on top of `base`, whose residuals were whitened by `common`: by a set of simulations
/// for each knot. A slot that a test cannot have, or that could not be simulated, is left out.
[[nodiscard]] tl::expected<Wandering, calibration::FitFailure> let_wander(
    const SlumpBasis& basis, const SlumpCandidate& base, const calibration::CommonError& common,
    const std::function<void(double)>& progress);

}  // namespace isotach::discovery
