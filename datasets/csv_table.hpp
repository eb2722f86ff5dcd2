// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A delimited text file as columns of text with line numbers, and its cells as numbers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/input_error.hpp"
#include "datasets/range.hpp"
#include "datasets/text_file.hpp"

namespace isotach::datasets {

/// A table read from a file as spreadsheets and logging programs write it.
///
/// The delimiter is the one of `,` `;` and tab that occurs most often in the header, the first line that is
/// neither blank nor a comment (#). Cells may be quoted ("", doubled inside), on one line. Blank lines, lines
/// of empty cells, comments, a byte order mark, CRLF and empty cells beyond the header's last are skipped.
/// Where the delimiter is not a comma, a comma in a number is the decimal mark.
class CsvTable {
 public:
  /// InputError: whatever read_text_file refuses; no header, no row, a column named twice, a row with more or
  /// fewer cells than the header, a quote that is not closed, a line of 16 MiB or more.
  [[nodiscard]] static CsvTable read(const std::filesystem::path& file, const ReadOptions& options = {});
  /// The same of a text in memory; `file` is only named in messages.
  [[nodiscard]] static CsvTable parse(std::string text, const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] std::size_t row_count() const { return lines_.size(); }
  /// The line of a row, for messages.
  [[nodiscard]] FilePlace place(std::size_t row) const { return {file_, lines_.at(row)}; }

  /// Index of the column of exactly that name.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
  /// Index of the column; InputError naming the columns there are, where it is missing.
  [[nodiscard]] std::size_t require(std::string_view name) const;
  /// The error of a table that has none of the columns asked for; `wanted` names them.
  [[nodiscard]] InputError missing_column(std::string_view wanted) const;

  /// The cell's text, without surrounding blanks and quotes.
  [[nodiscard]] std::string_view text(std::size_t row, std::size_t column) const;
  /// The cell's number; InputError where it is no finite number or lies outside of `accepted`.
  [[nodiscard]] double number(std::size_t row, std::size_t column, const Range& accepted = {}) const;

 private:
  CsvTable() = default;
  void read_header(std::string_view line, std::size_t line_number);
  void append_row(const std::vector<std::string>& cells, std::size_t line_number);

  std::filesystem::path file_;
  char delimiter_ = ',';
  std::size_t header_line_ = 0;
  std::vector<std::string> columns_;
  std::vector<std::size_t> lines_;      // of each row
  std::string cells_;                   // all cells, row by row, one after the other
  std::vector<std::size_t> cell_ends_;  // in cells_; cell i begins where cell i - 1 ends
};

}  // namespace isotach::datasets
