// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Points spread over a cube, the same on every platform.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace isotach::calibration {

/// `count` points of a Latin hypercube in the unit cube.
[[nodiscard]] std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimension,
                                                               std::mt19937_64& random);

}  // namespace isotach::calibration
