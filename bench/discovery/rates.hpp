// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the benchmark's records say: rates beside what is asked of them, and confusion matrices.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/discovery/record.hpp"

namespace isotach::bench {

/// One line of the table of rates.
struct Rate {
  std::string what;
  std::string asked;          ///< in words
  std::string found;          ///< "95.0 %", or a median
  std::string interval;       ///< Wilson's 95 %, or empty
  std::string counted;        ///< "19 of 20"
  std::optional<bool> met{};  ///< whether `found` is what is asked; nothing where nothing is asked, or found
};
[[nodiscard]] std::vector<Rate> rates_of(const std::vector<Record>& records);

/// How a record ended, in one word: "adequate", "unknown", "ambiguous", or what was named, "a + b".
[[nodiscard]] std::string outcome_of(const Record& record);

/// One line for each cell and outcome: kind, hidden, programme, noise, visibility, outcome, count. Studies
/// out of reach and failed ones have those words as outcome.
[[nodiscard]] std::string outcomes_csv(const std::vector<Record>& records);
[[nodiscard]] std::string rates_csv(const std::vector<Rate>& rates);

/// A page of Markdown: rates and what falls short, right names by cell, confusion matrices by programme,
/// conditions that refused names.
[[nodiscard]] std::string results_page(const std::vector<Record>& records, std::size_t planned,
                                       std::uint64_t seed);

}  // namespace isotach::bench
