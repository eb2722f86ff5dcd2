// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The law's closed forms, checked by every integrator.
#pragma once

#include <vector>

#include "verification/check.hpp"
#include "verification/reference_rows.hpp"

namespace isotach::verification {

/// Material constants, steady compression, tangent, rate jump, creep, relaxation, the transient of
/// compression, the undrained critical state, and the gauge, by each contender; those without integration
/// once.
[[nodiscard]] std::vector<Check> closed_form_checks(const std::vector<Contender>& contenders);

}  // namespace isotach::verification
