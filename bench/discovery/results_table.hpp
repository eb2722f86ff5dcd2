// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Parts of the benchmarks' pages of Markdown.
#pragma once

#include <string>
#include <vector>

#include "bench/discovery/rate.hpp"

namespace isotach::bench {

/// Appends a table and an empty line.
void add_table(std::string& page, const std::vector<std::string>& head,
               const std::vector<std::vector<std::string>>& rows);

/// Appends the rates, and in one sentence what is asked of them and not met; where `made` is less than
/// `planned` also that a part of the plan is no more than that.
void add_rates(std::string& page, const std::vector<Rate>& rates, std::size_t made, std::size_t planned);

/// Appends hidden against outcome, of the records that `of` takes; nothing where it takes none.
void add_confusion(std::string& page, const std::vector<Record>& records, const std::string& title,
                   const RecordTest& of);

}  // namespace isotach::bench
