// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A delimited text file as columns of text: implementation.
#include "datasets/csv_table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "datasets/delimited_line.hpp"

// The reader's own thread would only compete with those that run simulations.
#define CSV_IO_NO_THREAD
#include <libfccp/csv.h>

namespace isotach::datasets {
namespace {

char detect_delimiter(std::string_view header) {
  std::array<std::size_t, 3> counts{};
  constexpr std::string_view kDelimiters = ",;\t";
  bool quoted = false;
  for (const char c : header) {
    if (c == '"') quoted = !quoted;
    const std::size_t which = kDelimiters.find(c);
    if (!quoted && which != std::string_view::npos) ++counts[which];
  }
  const auto most = std::max_element(counts.begin(), counts.end());
  return kDelimiters[static_cast<std::size_t>(most - counts.begin())];
}

std::string list_of(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file, const ReadOptions& options) {
  return parse(read_text_file(file, options), file);
}

CsvTable CsvTable::parse(std::string text, const std::filesystem::path& file) {
  CsvTable table;
  table.file_ = file;
  std::string content = checked_text(std::move(text), file);
  // The line reader looks one byte beyond a last line without its newline.
  if (content.back() != '\n') content += '\n';
  table.cells_.reserve(content.size());
  io::LineReader reader(file.string(), content.data(), content.data() + content.size());
  std::vector<std::string> cells;
  try {
    while (const char* next = reader.next_line()) {
      const std::string_view line = trimmed(next);
      if (line.empty() || line.front() == '#') continue;
      if (table.columns_.empty()) {
        table.read_header(next, reader.get_file_line());
      } else {
        split_line(next, table.delimiter_, {file, reader.get_file_line()}, cells);
        table.append_row(cells, reader.get_file_line());
      }
    }
  } catch (const io::error::line_length_limit_exceeded&) {
    throw InputError({file, reader.get_file_line()}, "line", "it is too long", "lines shorter than 16 MiB");
  }
  if (table.columns_.empty()) {
    throw InputError({file}, "file", "it has no header, only blank lines and comments", "a header and rows");
  }
  if (table.lines_.empty()) {
    throw InputError({file, table.header_line_}, "file", "no row behind the header", "a header and rows");
  }
  return table;
}

void CsvTable::read_header(std::string_view line, std::size_t line_number) {
  header_line_ = line_number;
  delimiter_ = detect_delimiter(line);
  const FilePlace place{file_, line_number};
  split_line(line, delimiter_, place, columns_);
  while (!columns_.empty() && columns_.back().empty()) columns_.pop_back();
  if (columns_.empty()) throw InputError(place, "header", "no column has a name", "names of columns");
  for (auto name = columns_.begin(); name != columns_.end(); ++name) {
    if (!name->empty() && std::find(columns_.begin(), name, *name) != name) {
      throw InputError(place, "header", fmt::format("column {} occurs twice", *name), "each column once");
    }
  }
}

void CsvTable::append_row(const std::vector<std::string>& cells, std::size_t line_number) {
  const auto is_empty = [](const std::string& cell) { return cell.empty(); };
  if (std::all_of(cells.begin(), cells.end(), is_empty)) return;
  const FilePlace place{file_, line_number};
  const std::size_t count = columns_.size();
  if (cells.size() < count) {
    throw InputError(place, fmt::format("column {}", columns_[cells.size()]),
                     fmt::format("the row ends after {} cells", cells.size()),
                     fmt::format("{} cells, as in the header", count));
  }
  if (!std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(count), cells.end(), is_empty)) {
    throw InputError(
        place, "row", fmt::format("{} cells", cells.size()),
        fmt::format("{} cells, as in the header (decimal commas need ; or tab between cells)", count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    cells_ += cells[i];
    cell_ends_.push_back(cells_.size());
  }
  lines_.push_back(line_number);
}

std::optional<std::size_t> CsvTable::find(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::require(std::string_view name) const {
  if (const auto index = find(name)) return *index;
  throw missing_column(name);
}

InputError CsvTable::missing_column(std::string_view wanted) const {
  return {{file_, header_line_},
          fmt::format("column {} is missing; columns found: {}", wanted, list_of(columns_))};
}

std::string_view CsvTable::text(std::size_t row, std::size_t column) const {
  const std::size_t cell = row * columns_.size() + column;
  const std::size_t begin = cell == 0 ? 0 : cell_ends_.at(cell - 1);
  return std::string_view(cells_).substr(begin, cell_ends_.at(cell) - begin);
}

double CsvTable::number(std::size_t row, std::size_t column, const Range& accepted) const {
  return number_in(text(row, column), delimiter_ != ',', accepted, place(row),
                   fmt::format("column {}", columns_.at(column)));
}

}  // namespace isotach::datasets
