// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Properties that the law must have whatever its parameters, measured over random states and paths.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "verification/check.hpp"

namespace isotach::verification {

/// Objectivity, symmetry of the stiffness, gauge invariance, homogeneity in stress, non-negative viscous
/// dissipation, the critical state as an attractor, and the isotropic form as a special case, each over
/// `count` random states or paths of the seed; the worst of them is the number checked.
[[nodiscard]] std::vector<Check> property_checks(std::uint64_t seed, std::size_t count, int threads,
                                                 const std::atomic<bool>* stop);

}  // namespace isotach::verification
