// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The groups of an AGS4 file (Association of Geotechnical and Geoenvironmental Specialists, edition 4.1.1) as
// text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/input_error.hpp"
#include "datasets/range.hpp"

namespace isotach::datasets {

/// One group: a table of text.
struct Ags4Group {
  struct Row {
    std::size_t line;
    std::vector<std::string> cells;  ///< at most one a heading; what is missing is empty
  };

  std::string name;                   ///< in capital letters
  std::size_t line = 0;               ///< of its GROUP line
  std::vector<std::string> headings;  ///< in capital letters
  std::vector<std::string> units;     ///< likewise as many at most; empty where the file has no UNIT line
  std::vector<Row> rows;

  [[nodiscard]] std::optional<std::size_t> find(std::string_view heading) const;
  /// The cell; empty where the row or the group has none.
  [[nodiscard]] std::string_view text(const Row& row, std::string_view heading) const;
  [[nodiscard]] std::string_view unit(std::string_view heading) const;
};

/// The groups of a file.
///
/// Taken as found: groups, headings and the words at the start of a line in small letters, CRLF, a byte order
/// mark, UNIT and TYPE lines missing, cells without quotes, rows that end early, blank lines, a group that is
/// continued under the same headings.
class Ags4File {
 public:
  /// InputError: whatever checked_text refuses; a file of AGS 3; a line that starts with none of GROUP,
  /// HEADING, UNIT, TYPE, DATA; a line out of order; a heading twice; a row longer than its headings; no
  /// group.
  [[nodiscard]] static Ags4File parse(std::string text, const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] FilePlace place(const Ags4Group::Row& row) const { return {file_, row.line}; }
  /// The group of that name (in capital letters); null where there is none.
  [[nodiscard]] const Ags4Group* find(std::string_view group) const;
  /// The names of all groups.
  [[nodiscard]] std::vector<std::string_view> group_names() const;
  /// The cell's number; nothing where it is empty. InputError: no finite number, or outside of `accepted`.
  [[nodiscard]] std::optional<double> number(const Ags4Group& group, const Ags4Group::Row& row,
                                             std::string_view heading, const Range& accepted) const;

 private:
  Ags4File() = default;
  void take_line(std::size_t line, const std::vector<std::string>& cells);
  void take_headings(Ags4Group group);

  std::filesystem::path file_;
  std::vector<Ags4Group> groups_;
  std::optional<std::size_t> open_;   // index of the group that lines belong to, once it has headings
  std::optional<Ags4Group> waiting_;  // a GROUP line whose HEADING line has not come
};

}  // namespace isotach::datasets
