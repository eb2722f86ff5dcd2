// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the fits to slump tests amount to: whether the base is met, and what may be named.
#pragma once

#include "discovery/slump_discovery.hpp"

namespace isotach::discovery {

/// Whether every fitted test is met to within its noise and the error of the simulations.
[[nodiscard]] bool meets_noise(const SlumpCandidate& candidate);

/// The scale of the residuals' variance, BIC by it, which the trials are sorted by, and whether each is
/// adequate. `null` says how much noise lets the best of all effects gain.
void weigh(SlumpDiscovery& found, const ScoreTest& null);

/// Verdict, what is chosen or equivalent, conditions and the best of the wrong.
void decide(SlumpDiscovery& found);

}  // namespace isotach::discovery
