// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The consistent tangent against automatic differentiation by another route, finite differences, and the
// tangent of the exact solution.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "verification/check.hpp"

namespace isotach::verification {

/// Relative errors |C - C_other|/|C_other| (Frobenius) of one random increment.
struct TangentRecord {
  std::uint64_t index;
  double strain;          ///< |D| dt of the increment
  double jets;            ///< against Jets through law, parameters and increment, six at once: the same map
  double differences;     ///< one substep: against central differences of the discrete map
  double exact_solution;  ///< against central differences of the reference: what the map itself lacks
};

struct TangentStudy {
  double tolerance;  ///< of Fellin-Ostermann
  std::vector<TangentRecord> records;
  std::size_t skipped = 0;  ///< increments that one of the integrations could not do
};

/// First increments of the random paths 0 .. count-1 of the seed, cut to a strain of 1e-5 to 1e-2.
[[nodiscard]] TangentStudy tangent_study(std::uint64_t seed, std::size_t count, int threads,
                                         const std::atomic<bool>* stop);

/// Medians: 1e-8 where exact (Jets, and differences to their own accuracy), 1e-3 against the exact solution.
[[nodiscard]] std::vector<Check> checks_of(const TangentStudy& study);

}  // namespace isotach::verification
