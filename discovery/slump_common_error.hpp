// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the numerics of simulations do alike to all slump tests that discovery looks at.
#pragma once

#include <tl/expected.hpp>

#include "calibration/common_error.hpp"
#include "discovery/slump_candidate.hpp"

namespace isotach::discovery {

/// By the variants of the simulations' error that were measured, and, where the study names no reference
/// numerics, by the other scheme of transfer, which is simulated at the basis' start: codes differ by it, and
/// so may data that come from one. A variant that failed in some test gives no direction.
[[nodiscard]] tl::expected<calibration::CommonError, calibration::FitFailure> common_error(
    const SlumpBasis& basis, const SlumpTests& tests);

}  // namespace isotach::discovery
