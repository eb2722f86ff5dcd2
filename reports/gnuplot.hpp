// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Running gnuplot on a script, and quoting text for it.
#pragma once

#include <string>
#include <string_view>

namespace isotach::reports {

/// What gnuplot, found on PATH and deaf to the user's settings, writes to standard output for the script. No
/// shell is involved. Throws std::runtime_error, with gnuplot's standard error, where it is missing or fails.
[[nodiscard]] std::string run_gnuplot(std::string_view script);

/// The text as a gnuplot string that stands for exactly these characters: nothing in it is expanded. Control
/// characters, line ends included, become spaces.
[[nodiscard]] std::string gnuplot_quoted(std::string_view text);

}  // namespace isotach::reports
