// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Numbers and durations as text for tables, captions and messages.
#pragma once

#include <string>

namespace isotach::reports {

/// What stands in a table where there is no number: an en dash.
inline constexpr const char* kMissing = "–";

/// A number with the given count of significant digits (1 to 17), trailing zeros kept, in UTF-8 with a true
/// minus sign. Fixed notation from 0.001 up to a million ("0.0129", "123500"), else scientific
/// ("6.80×10⁻⁷"); zero is "0" and what is not finite is kMissing.
[[nodiscard]] std::string format_number(double value, int significant_digits = 4);

/// A value with its standard error (same unit), both rounded to the second digit of the error:
/// "1.3583 ± 0.0021", "(6.80 ± 0.12)×10⁻⁷". The value alone, as format_number gives it, where the error is
/// not a positive finite number; kMissing where the value is not finite.
[[nodiscard]] std::string format_with_error(double value, double standard_error);

/// A duration (s, rounded to the second above 10 s) as people say it: "0.42 s", "45 s", "3 min 20 s",
/// "2 h 05 min". kMissing where it is negative or not finite.
[[nodiscard]] std::string format_duration(double seconds);

}  // namespace isotach::reports
