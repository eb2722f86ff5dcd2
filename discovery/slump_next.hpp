// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which slump would tell two explanations apart: tests already made, changed in fill or lift.
#pragma once

#include "discovery/slump_discovery.hpp"

namespace isotach::discovery {

/// The variation of the first fitted test, or another fitted test as it is, in which the predictions of `a`
/// and `b`, each at its own parameters, differ most; nothing where none could be simulated.
[[nodiscard]] std::optional<NextExperiment> tell_slumps_apart(const SlumpBasis& basis,
                                                              const SlumpCandidate& a,
                                                              const SlumpCandidate& b);

}  // namespace isotach::discovery
