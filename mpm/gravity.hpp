// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What weights are made of.
#pragma once

namespace isotach::mpm {

inline constexpr double kGravity = 9.81;         ///< m/s2
inline constexpr double kWaterDensity = 1000.0;  ///< kg/m3

}  // namespace isotach::mpm
