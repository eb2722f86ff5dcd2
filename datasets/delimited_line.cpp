// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cells of a delimited line: implementation.
#include "datasets/delimited_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace isotach::datasets {
namespace {

/// The text of a quoted cell; `rest` starts at its opening quote and is moved behind the closing one.
std::string take_quoted(std::string_view& rest, const FilePlace& place) {
  std::string cell;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] != '"') {
      cell += rest[i];
    } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
      cell += '"';
      ++i;
    } else {
      rest.remove_prefix(i + 1);
      return cell;
    }
  }
  throw InputError(place, "quoted cell", fmt::format("{} has no closing quote", rest.substr(0, 40)),
                   "a cell that is closed on its line");
}

}  // namespace

void split_line(std::string_view line, char delimiter, const FilePlace& place,
                std::vector<std::string>& cells) {
  cells.clear();
  const std::string_view blanks = delimiter == '\t' ? " \r" : " \t\r";
  while (true) {
    const std::size_t first = std::min(line.find_first_not_of(blanks), line.size());
    if (first < line.size() && line[first] == '"') {
      line.remove_prefix(first);
      cells.push_back(take_quoted(line, place));
      const std::size_t next = std::min(line.find(delimiter), line.size());
      if (!trimmed(line.substr(0, next)).empty()) {
        throw InputError(place, "quoted cell",
                         fmt::format("\"{}\" behind its closing quote", line.substr(0, next)),
                         "nothing between a closing quote and the delimiter");
      }
      if (next == line.size()) return;
      line.remove_prefix(next + 1);
      continue;
    }
    const std::size_t next = std::min(line.find(delimiter), line.size());
    cells.emplace_back(trimmed(line.substr(0, next)));
    if (next == line.size()) return;
    line.remove_prefix(next + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

double number_in(std::string_view cell, bool decimal_comma, const Range& accepted, const FilePlace& place,
                 std::string_view subject) {
  std::string digits(cell);
  if (decimal_comma) std::replace(digits.begin(), digits.end(), ',', '.');
  // from_chars knows no plus sign
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.erase(0, 1);
  const char* const end = digits.data() + digits.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  const auto refuse = [&](std::string_view why) {
    return InputError(place, subject, fmt::format("\"{}\" {}", cell, why), accepted.words());
  };
  if (stop != end || error == std::errc::invalid_argument) throw refuse("is not a number");
  if (error != std::errc{} || !std::isfinite(value)) throw refuse("is not a finite number");
  if (!accepted.contains(value)) throw refuse("is out of range");
  return value;
}

}  // namespace isotach::datasets
