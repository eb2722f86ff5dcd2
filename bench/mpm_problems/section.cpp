// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

namespace {

std::string row_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

std::string markdown(const Section& section) {
  std::string text = "## " + section.title + "\n" + section.text + "\n";
  for (const SectionTable& table : section.tables) {
    text += "\n" + row_of(table.head) + row_of(std::vector<std::string>(table.head.size(), "---"));
    for (const auto& row : table.rows) text += row_of(row);
  }
  return text + "\n";
}

}  // namespace isotach::bench
