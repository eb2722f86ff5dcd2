// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How a row holds the result of a simulation: three columns that give it back to the last bit.
#pragma once

#include <optional>
#include <string>

#include "mpm/slump.hpp"

namespace isotach::journal {

struct ResultColumns {
  /// Little-endian: the number of outlines (uint64); of each its time (double, s), the number of its points
  /// (uint64), and of each point r and z (double, m).
  std::string outlines;
  /// Little-endian: the number of rows (uint64), of each the nine doubles of mpm::HistoryRow in its order.
  std::string history;
  /// JSON: the initial state, sizes, errors and counts by name, SI.
  std::string measures;
};

/// All of the result but snapshots, fields and frames, which fits do not ask for.
[[nodiscard]] ResultColumns columns_of(const mpm::SlumpResult& result);

/// The reverse; nothing where a column is not whole.
[[nodiscard]] std::optional<mpm::SlumpResult> result_of(const ResultColumns& columns);

}  // namespace isotach::journal
