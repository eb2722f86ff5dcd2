// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The weight of a kilogram.
#pragma once

namespace isotach::mpm {

inline constexpr double kGravity = 9.81;  ///< m/s2

}  // namespace isotach::mpm
