// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The exception for everything a user can get wrong in a file: where, what was found, what is accepted.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace isotach::datasets {

/// A line of a file, or the file as a whole where `line` is 0.
struct FilePlace {
  std::filesystem::path file;
  std::size_t line = 0;  ///< counted from 1

  /// "file:line", or "file".
  [[nodiscard]] std::string text() const {
    return line == 0 ? file.string() : fmt::format("{}:{}", file.string(), line);
  }
};

/// A user input error. what() is one line that starts with the file and the line, e.g.
/// `crs-1.csv:17: column axial_stress_kPa: "abc" is not a number; accepted: a finite number`.
class InputError : public std::runtime_error {
 public:
  InputError(const FilePlace& place, std::string_view problem)
      : std::runtime_error(fmt::format("{}: {}", place.text(), problem)) {}

  /// `found` says what `subject` (a column, a key, the file) holds; `accepted` what it may hold.
  InputError(const FilePlace& place, std::string_view subject, std::string_view found,
             std::string_view accepted)
      : std::runtime_error(fmt::format("{}: {}: {}; accepted: {}", place.text(), subject, found, accepted)) {}
};

}  // namespace isotach::datasets
