// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/convergence.hpp"

#include <fmt/format.h>

namespace isotach::bench {

Convergence::Convergence(std::vector<std::string> choices, std::vector<std::string> errors,
                         std::vector<std::string> remarks) {
  table_.head = std::move(choices);
  table_.head.emplace_back("cells");
  for (const std::string& error : errors) {
    table_.head.push_back(error);
    table_.head.emplace_back("order");
  }
  for (std::string& remark : remarks) table_.head.push_back(std::move(remark));
}

void Convergence::add(const std::vector<std::string>& choices, double cells,
                      const std::vector<double>& errors, const std::vector<std::string>& remarks) {
  const bool goes_on = choices == last_choices_ && !last_errors_.empty();
  std::vector<std::string> row = choices;
  row.push_back(fmt::format("{:g}", cells));
  for (std::size_t k = 0; k < errors.size(); ++k) {
    row.push_back(fmt::format("{:.2e}", errors[k]));
    row.push_back(goes_on ? fmt::format("{:.2f}", order(last_errors_[k], errors[k], cells / last_cells_))
                          : "");
  }
  row.insert(row.end(), remarks.begin(), remarks.end());
  table_.rows.push_back(std::move(row));
  last_choices_ = choices;
  last_cells_ = cells;
  last_errors_ = errors;
}

}  // namespace isotach::bench
