// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The units in which reports show lengths and stresses.
#pragma once

namespace isotach::reports {

inline constexpr double kMillimetres = 1e3;  ///< in a metre
inline constexpr double kPerPascal = 1e-3;   ///< kPa

}  // namespace isotach::reports
