// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the records of oedometer studies say: rates beside what is asked of them, and confusion matrices.
#pragma once

#include <string>
#include <vector>

#include "bench/discovery/rate.hpp"

namespace isotach::bench {

[[nodiscard]] std::vector<Rate> rates_of(const std::vector<Record>& records);

/// One line for each cell and outcome: kind, hidden, programme, noise, visibility, outcome, count. Studies
/// out of reach and failed ones have those words as outcome.
[[nodiscard]] std::string outcomes_csv(const std::vector<Record>& records);

/// A page of Markdown: rates and what falls short, right names by cell, confusion matrices by programme,
/// conditions that refused names.
[[nodiscard]] std::string results_page(const std::vector<Record>& records, std::size_t planned,
                                       std::uint64_t seed);

}  // namespace isotach::bench
