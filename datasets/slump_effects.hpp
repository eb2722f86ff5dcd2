// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the effects of slump tests make of a test.
#pragma once

#include <optional>
#include <string>

#include "effects/values.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::datasets {

/// The setup with those of the effects that are of slump tests; the same where there are none.
[[nodiscard]] mpm::SlumpSetup with_effects(mpm::SlumpSetup setup, const effects::Values<double>& effects);

/// Why a test cannot have an effect; nothing where it can.
[[nodiscard]] std::optional<std::string> why_not(const mpm::SlumpSetup& setup, const effects::Effect& effect);

}  // namespace isotach::datasets
