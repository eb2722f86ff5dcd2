// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A random material, state and strain path over the admissible range, the same for the same seed and index.
#pragma once

#include <cstdint>

#include "verification/path.hpp"

namespace isotach::verification {

/// Path `index` of the family `seed`. Nothing is shared between indices, so each can be made by itself.
///
/// Parameters: lambda 0.02 to 0.4, kappa/lambda 0.03 to 0.5, I_v 0.01 to 0.1, phi_c 10 to 40 deg, D_r 1e-9 to
/// 1e-4 /s, e100 0.5 to 4, C_1 zero or up to 0.9 (1 - kappa/lambda); one path in four has C_2 up to 100, C_3
/// up to 0.8 and an inclined ellipse at the start. State: p 0.1 kPa to 1 MPa, |T*| up to 0.95 of the critical
/// state in a random direction, OCR 0.8 to 50. Path: one to four segments of strain, in all up to 0.5 of
/// integral |D| dt, at 1e-9 to 1e3 /s each, in a random direction (isochoric, nearly so, or any), or back the
/// way the last one came; holds of strain between them. Positive numbers are spread evenly in the logarithm.
[[nodiscard]] Path random_path(std::uint64_t seed, std::uint64_t index);

}  // namespace isotach::verification
