// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Numbers as JSON from which they come back to the last bit.
#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace isotach::journal {

/// JSON has no infinities and no NaN: they are the strings "inf", "-inf" and "nan".
[[nodiscard]] inline nlohmann::ordered_json exact_json(double value) {
  if (std::isfinite(value)) return value;
  if (std::isnan(value)) return "nan";
  return value > 0.0 ? "inf" : "-inf";
}

/// The reverse. nlohmann's exceptions where it is neither.
[[nodiscard]] inline double exact_number(const nlohmann::ordered_json& json) {
  if (!json.is_string()) return json.get<double>();
  const auto text = json.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  return (text == "-inf" ? -1.0 : 1.0) * std::numeric_limits<double>::infinity();
}

}  // namespace isotach::journal
