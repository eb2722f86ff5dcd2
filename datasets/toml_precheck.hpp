// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Looks over a TOML text for what the parser meets with undefined behaviour instead of an error.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace isotach::datasets {

/// What is wrong with a TOML text, and in which line (from 1).
struct TomlDefect {
  std::size_t line;
  std::string_view what;
};

/// The first place that TOML++ 3.3 must not be shown: a table header that begins with neither a key nor a
/// closing bracket, such as `[)`; a bracket closed by one of another kind, such as `[}`; a quote inside of a
/// word, such as `0.1'`; a character outside of ASCII that is neither in quotes nor in a comment, or that
/// follows a backslash in a string. All are errors of TOML anyway, but for the rarity of such a character
/// behind a line-ending backslash; for none of them does the parser check what it then takes for granted.
[[nodiscard]] std::optional<TomlDefect> find_toml_defect(std::string_view toml);

}  // namespace isotach::datasets
