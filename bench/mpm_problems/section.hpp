// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a verification problem of the MPM engine contributes to the report: words and tables.
#pragma once

#include <string>
#include <vector>

namespace isotach::bench {

struct SectionTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

struct Section {
  std::string title;
  std::string text;  ///< what is solved, what is exact about it, its source; paragraphs of Markdown
  std::vector<SectionTable> tables;
};

/// The section in Markdown, its title at the second level.
[[nodiscard]] std::string markdown(const Section& section);

}  // namespace isotach::bench
