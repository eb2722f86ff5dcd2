// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What ranks beside rank 0 do: simulate what they are asked for until they may leave.
#pragma once

#include <atomic>

#include "cluster/ranks.hpp"

namespace isotach::cluster {

/// Serves rank 0, each simulation by one thread, until it says leave; returns the exit code that it said.
/// Once `interrupted` is true simulations end as interrupted, which ends the fit. Waits in short sleeps, so
/// that a rank that has nothing to do leaves its core to others.
[[nodiscard]] int serve(const Ranks& ranks, const std::atomic<bool>& interrupted);

/// Rank 0: lets all others leave with this exit code.
void let_leave(const Ranks& ranks, int exit_code);

}  // namespace isotach::cluster
