// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The cells of one line of a delimited text file, and the number that a cell holds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "datasets/input_error.hpp"
#include "datasets/range.hpp"

namespace isotach::datasets {

/// `text` without the blanks, tabs and carriage returns at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Splits a line into `cells` (reused from line to line), each without surrounding blanks. A cell may be
/// quoted ("", doubled inside). InputError at `place`: a quote that is not closed, or text behind one.
void split_line(std::string_view line, char delimiter, const FilePlace& place,
                std::vector<std::string>& cells);

/// The finite number that `cell` holds; with `decimal_comma` a comma is the decimal mark.
/// InputError at `place`, about `subject`: no finite number, or one outside of `accepted`.
[[nodiscard]] double number_in(std::string_view cell, bool decimal_comma, const Range& accepted,
                               const FilePlace& place, std::string_view subject);

}  // namespace isotach::datasets
