// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Resampling of correlated values in blocks: the stationary bootstrap.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace isotach::calibration {

/// Indices below `count`, as many, of one resample by the stationary bootstrap (Politis & Romano 1994):
/// blocks of consecutive indices, the first after the last again being 0, begin anywhere with equal
/// probability and have geometrically distributed lengths of mean `block`. `block` 1 is the plain bootstrap.
/// Throws std::invalid_argument for block 0.
[[nodiscard]] std::vector<std::size_t> resample_blocks(std::size_t count, std::size_t block,
                                                       std::mt19937_64& generator);

/// The mean block length for `n` values of correlation s rho^lag, s = serial_share: with s = 1
/// (2 rho/(1 - rho^2))^(2/3) n^(1/3), rounded up. That minimises the mean square error of the stationary
/// bootstrap's variance of a mean (Politis & White 2004, with the constant as corrected by Patton, Politis &
/// White 2009: (2 G^2/D)^(1/3) n^(1/3), G = 2 s rho/(1 - rho)^2, D = 2 [1 - s + s (1 + rho)/(1 - rho)]^2). At
/// least 1, at most 3 sqrt(n) and n/3, as they advise. Throws std::invalid_argument for rho outside (-1, 1),
/// a share outside [0, 1] and n = 0; a negative rho counts as its absolute value.
[[nodiscard]] std::size_t block_length(double rho, std::size_t n, double serial_share = 1.0);

}  // namespace isotach::calibration
