// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The groups of an AGS4 file: implementation.
#include "datasets/ags4.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "datasets/delimited_line.hpp"
#include "datasets/text_file.hpp"

namespace isotach::datasets {
namespace {

constexpr std::string_view kLineKinds = "lines that start with GROUP, HEADING, UNIT, TYPE or DATA";

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return capitals;
}

/// The cells behind the first, at most `count` of them; what lies beyond must be empty.
std::vector<std::string> cells_of_row(const std::vector<std::string>& cells, std::size_t count,
                                      const FilePlace& place, std::string_view group) {
  for (std::size_t i = count + 1; i < cells.size(); ++i) {
    if (cells[i].empty()) continue;
    throw InputError(place, fmt::format("group {}", group),
                     fmt::format("a row of {} cells", cells.size() - 1),
                     fmt::format("{} cells, one for each heading", count));
  }
  const auto end = cells.begin() + static_cast<std::ptrdiff_t>(std::min(cells.size(), count + 1));
  return {cells.begin() + 1, end};
}

}  // namespace

std::optional<std::size_t> Ags4Group::find(std::string_view heading) const {
  const auto found = std::find(headings.begin(), headings.end(), heading);
  if (found == headings.end()) return std::nullopt;
  return static_cast<std::size_t>(found - headings.begin());
}

std::string_view Ags4Group::text(const Row& row, std::string_view heading) const {
  const auto column = find(heading);
  return column && *column < row.cells.size() ? std::string_view(row.cells[*column]) : std::string_view();
}

std::string_view Ags4Group::unit(std::string_view heading) const {
  const auto column = find(heading);
  return column && *column < units.size() ? std::string_view(units[*column]) : std::string_view();
}

Ags4File Ags4File::parse(std::string text, const std::filesystem::path& file) {
  Ags4File result;
  result.file_ = file;
  const std::string content = checked_text(std::move(text), file);
  std::string_view rest = content;
  std::vector<std::string> cells;
  for (std::size_t line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text_line = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (text_line.empty()) continue;
    if (text_line.starts_with("\"**") || text_line.starts_with("**")) {
      throw InputError({file, line}, "format", "a group as in AGS 3", "AGS 4");
    }
    split_line(text_line, ',', {file, line}, cells);
    result.take_line(line, cells);
  }
  if (result.waiting_) {
    throw InputError({file, result.waiting_->line}, fmt::format("group {}", result.waiting_->name),
                     "it has no headings", "a HEADING line behind each GROUP line");
  }
  if (result.groups_.empty()) throw InputError({file}, "file", "it has no group", std::string(kLineKinds));
  return result;
}

void Ags4File::take_line(std::size_t line, const std::vector<std::string>& cells) {
  const FilePlace place{file_, line};
  const std::string kind = in_capitals(cells.front());
  if (kind == "GROUP") {
    const std::string name = cells.size() > 1 ? in_capitals(cells[1]) : "";
    if (name.empty()) throw InputError(place, "GROUP line", "no name", "the name of a group");
    if (waiting_) {
      throw InputError({file_, waiting_->line}, fmt::format("group {}", waiting_->name), "it has no headings",
                       "a HEADING line behind each GROUP line");
    }
    waiting_ = Ags4Group{name, line, {}, {}, {}};
    open_.reset();
    return;
  }
  if (kind == "HEADING") {
    if (!waiting_) throw InputError(place, "HEADING line", "no GROUP line before it", "one for each group");
    Ags4Group group = *std::exchange(waiting_, std::nullopt);
    for (std::size_t i = 1; i < cells.size(); ++i) group.headings.push_back(in_capitals(cells[i]));
    while (!group.headings.empty() && group.headings.back().empty()) group.headings.pop_back();
    take_headings(std::move(group));
    return;
  }
  if (kind != "UNIT" && kind != "TYPE" && kind != "DATA") {
    throw InputError(place, "line", fmt::format("it starts with \"{}\"", cells.front().substr(0, 40)),
                     kLineKinds);
  }
  if (!open_) {
    throw InputError(place, fmt::format("{} line", kind), "no HEADING line before it",
                     "GROUP, HEADING, UNIT, TYPE and DATA in this order");
  }
  Ags4Group& group = groups_[*open_];
  if (kind == "TYPE") return;
  std::vector<std::string> row = cells_of_row(cells, group.headings.size(), place, group.name);
  if (kind == "UNIT") {
    group.units = std::move(row);
  } else {
    group.rows.push_back({line, std::move(row)});
  }
}

void Ags4File::take_headings(Ags4Group group) {
  const FilePlace place{file_, group.line};
  const std::string subject = fmt::format("group {}", group.name);
  for (auto heading = group.headings.begin(); heading != group.headings.end(); ++heading) {
    if (!heading->empty() && std::find(group.headings.begin(), heading, *heading) != heading) {
      throw InputError(place, subject, fmt::format("heading {} occurs twice", *heading), "each heading once");
    }
  }
  const auto same_name = [&](const Ags4Group& other) { return other.name == group.name; };
  const auto known = std::find_if(groups_.begin(), groups_.end(), same_name);
  if (known == groups_.end()) {
    open_ = groups_.size();
    groups_.push_back(std::move(group));
    return;
  }
  if (known->headings != group.headings) {
    throw InputError(place, subject, fmt::format("it stands at line {} with other headings", known->line),
                     "each group once");
  }
  open_ = static_cast<std::size_t>(known - groups_.begin());
}

const Ags4Group* Ags4File::find(std::string_view group) const {
  const auto same_name = [&](const Ags4Group& other) { return other.name == group; };
  const auto found = std::find_if(groups_.begin(), groups_.end(), same_name);
  return found == groups_.end() ? nullptr : &*found;
}

std::vector<std::string_view> Ags4File::group_names() const {
  std::vector<std::string_view> names;
  for (const Ags4Group& group : groups_) names.push_back(group.name);
  return names;
}

std::optional<double> Ags4File::number(const Ags4Group& group, const Ags4Group::Row& row,
                                       std::string_view heading, const Range& accepted) const {
  const std::string_view cell = group.text(row, heading);
  if (cell.empty()) return std::nullopt;
  return number_in(cell, false, accepted, place(row), fmt::format("heading {}", heading));
}

}  // namespace isotach::datasets
