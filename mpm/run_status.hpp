// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How a slump run ended, in one word.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "mpm/slump.hpp"

namespace isotach::mpm {

enum class RunStatus {
  ok,
  not_settled,     ///< results as with ok, but the mud moved fast at the last output time
  crashed,         ///< the numerics broke down
  timed_out,       ///< longer than the wall time it was given
  outside_domain,  ///< mud left the grid or the slab
  interrupted      ///< stopped on request: says nothing on the run
};
inline constexpr std::size_t kRunStatusCount = 6;

/// "ok", "not settled", "crashed", "timed out", "outside the domain", "interrupted".
[[nodiscard]] std::string_view name_of(RunStatus status);

/// Share of energy above which a run counts as not settled: in a fill of 140 mm a mean speed of 12 mm/s. The
/// outlines are results all the same, since a test may be filmed while the mud flows.
inline constexpr double kSettledShare = 1e-4;

/// Kinetic energy at the last output time, without the factor on inertia, which would magnify a creep that
/// has none, over the potential energy at the start.
[[nodiscard]] double kinetic_share(const SlumpResult& result);

[[nodiscard]] RunStatus status_of(const SlumpResult& result);
[[nodiscard]] RunStatus status_of(const SlumpFailure& failure);

/// Why a run gave no result.
struct RunFailure {
  RunStatus status;
  std::string message;
};

/// Runs counted by how they ended.
struct RunCounts {
  std::array<long, kRunStatusCount> by_status{};

  [[nodiscard]] long& operator[](RunStatus status) { return by_status[static_cast<std::size_t>(status)]; }
  [[nodiscard]] long operator[](RunStatus status) const {
    return by_status[static_cast<std::size_t>(status)];
  }
  [[nodiscard]] long total() const {
    long sum = 0;
    for (const long count : by_status) sum += count;
    return sum;
  }
  RunCounts& operator+=(const RunCounts& more) {
    for (std::size_t i = 0; i < kRunStatusCount; ++i) by_status[i] += more.by_status[i];
    return *this;
  }
};

}  // namespace isotach::mpm
