// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/section.hpp"

#include <fmt/format.h>

namespace isotach::bench {

namespace {

std::string row_of(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

}  // namespace

std::string markdown(const Section& section) {
  std::string text = fmt::format("## {}\n{}\n", section.title, section.text);
  for (const SectionTable& table : section.tables) {
    text +=
        fmt::format("\n{}{}", row_of(table.head), row_of(std::vector<std::string>(table.head.size(), "---")));
    for (const auto& row : table.rows) text += row_of(row);
  }
  return text + "\n";
}

}  // namespace isotach::bench
