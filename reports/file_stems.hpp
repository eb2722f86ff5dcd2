// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// File names made of the names of tests.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

namespace isotach::reports {

/// Unique stems of file names: characters that are not safe become "_", and a number follows where two names
/// would become one.
class FileStems {
 public:
  [[nodiscard]] std::string of(const std::string& test) {
    std::string stem = test;
    for (char& c : stem) {
      const bool safe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                        c == '-' || c == '_' || c == '.';
      if (!safe) c = '_';
    }
    const std::string first = stem;
    for (int number = 2; !used_.insert(stem).second; ++number) stem = fmt::format("{}_{}", first, number);
    return stem;
  }

 private:
  std::set<std::string> used_;
};

}  // namespace isotach::reports
