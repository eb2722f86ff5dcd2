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
  not_settled,     ///< results as with ok, but at the last output time the mud still moved with inertia
  crashed,         ///< the numerics broke down
  timed_out,       ///< longer than the wall time it was given
  outside_domain,  ///< mud left the grid or the slab
  interrupted      ///< stopped on request: says nothing on the run
};
inline constexpr std::size_t kRunStatusCount = 6;

/// "ok", "not settled", "crashed", "timed out", "outside the domain", "interrupted".
[[nodiscard]] std::string_view name_of(RunStatus status);

/// Kinetic energy at the last output time over the potential energy at the start above which a run counts as
/// not settled: some times what the engine lets it be while inertia has no say (3e-5). The outlines are
/// results all the same, since a test may be filmed while the mud flows.
inline constexpr double kSettledShare = 1e-4;

/// Of a run with its history: kinetic energy at the end over potential energy at the start.
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
