// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An interval of accepted numbers that can say itself in words.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

namespace isotach::datasets {

/// Accepted values of a number, in the unit in which the file states it. NaN and infinities are never inside.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;  ///< `lower` itself is excluded
  bool upper_open = false;  ///< `upper` itself is excluded

  /// 0 < x <= upper
  [[nodiscard]] static constexpr Range positive(double upper = std::numeric_limits<double>::infinity()) {
    return {0.0, upper, true, false};
  }

  [[nodiscard]] bool contains(double value) const {
    return std::isfinite(value) && (lower_open ? value > lower : value >= lower) &&
           (upper_open ? value < upper : value <= upper);
  }

  /// For example "> 0 and <= 20", or "a finite number" where nothing bounds it.
  [[nodiscard]] std::string words() const {
    const std::string from = std::isfinite(lower) ? fmt::format("{} {}", lower_open ? ">" : ">=", lower) : "";
    const std::string to = std::isfinite(upper) ? fmt::format("{} {}", upper_open ? "<" : "<=", upper) : "";
    if (from.empty() && to.empty()) return "a finite number";
    return from.empty() || to.empty() ? from + to : from + " and " + to;
  }
};

}  // namespace isotach::datasets
