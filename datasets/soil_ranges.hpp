// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What laboratories may state of any soil, in the units of AGS4 and of the Dutch subsurface registry.
#pragma once

#include "datasets/range.hpp"

namespace isotach::datasets {

inline constexpr Range kWaterContent_pct = Range::positive(4000.0);
inline constexpr Range kDensity{0.5, 5.0};  ///< Mg/m3, of the soil as a whole

}  // namespace isotach::datasets
