// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One study of the benchmark: made, given to discovery, and what came of it.
#pragma once

#include "bench/discovery/plan.hpp"
#include "bench/discovery/record.hpp"

namespace isotach::bench {

/// On one thread. Whatever goes wrong is in the record.
[[nodiscard]] Record run_case(const Case& one, std::uint64_t seed);

}  // namespace isotach::bench
