// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A share or a median of the benchmark's records, beside what is asked of it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/discovery/record.hpp"

namespace isotach::bench {

using RecordTest = std::function<bool(const Record&)>;

[[nodiscard]] bool is_done(const Record& record);
[[nodiscard]] bool is_named(const Record& record);
/// Named is what is hidden, and nothing else; true also where nothing is hidden and nothing named.
[[nodiscard]] bool is_right(const Record& record);
[[nodiscard]] bool is_wrong(const Record& record);  ///< named, and not right
/// An ambiguous set holds what is hidden.
[[nodiscard]] bool set_holds_hidden(const Record& record);

/// "a + b", or "nothing".
[[nodiscard]] std::string joined(const std::vector<std::string>& names);
/// How a record ended, in one word: "adequate", "unknown", "ambiguous", or what was named, "a + b"; its state
/// where it is not done.
[[nodiscard]] std::string outcome_of(const Record& record);

/// What a share or a median is to be, in per cent.
struct Asked {
  double least = 0.0;
  double most = 100.0;

  [[nodiscard]] bool anything() const { return least > 0.0 || most < 100.0; }
  [[nodiscard]] bool met_by(double found) const { return found >= least && found <= most; }
  [[nodiscard]] std::string words() const;
};

/// One line of the table of rates.
struct Rate {
  std::string what;
  std::string asked;          ///< in words
  std::string found;          ///< "95.0 %", or a median; "-" where nothing was counted
  std::string interval;       ///< Wilson's 95 %, or empty
  std::string counted;        ///< "19 of 20"
  std::optional<bool> met{};  ///< whether `found` is what is asked; nothing where nothing is asked, or found
};

/// The share of `hit` among the records that are done and `of` takes.
[[nodiscard]] Rate share(const std::vector<Record>& records, std::string what, const Asked& asked,
                         const RecordTest& of, const RecordTest& hit);
/// The median of `values`, of which 1 is written as 100 %.
[[nodiscard]] Rate median(std::vector<double> values, std::string what, const Asked& asked);
/// The median relative error of the amplitude, of the records that are done, have one and `of` takes.
[[nodiscard]] Rate amplitude_error(const std::vector<Record>& records, std::string what, const Asked& asked,
                                   const RecordTest& of);

[[nodiscard]] std::string rates_csv(const std::vector<Rate>& rates);

}  // namespace isotach::bench
