// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the records of slump studies say.
#pragma once

#include <string>
#include <vector>

#include "bench/discovery/rate.hpp"

namespace isotach::bench {

[[nodiscard]] std::vector<Rate> slump_rates_of(const std::vector<Record>& records);

/// A page of Markdown: rates and what falls short, the confusion matrix, and a line for each study.
[[nodiscard]] std::string slump_results_page(const std::vector<Record>& records, std::size_t planned,
                                             std::uint64_t seed);

}  // namespace isotach::bench
