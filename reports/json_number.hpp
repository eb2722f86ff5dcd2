// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A double as JSON: a number, or null where there is none.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace isotach::reports {

/// The value, or null where it is not finite: a number that does not exist is null, never NaN. Assigns to
/// nlohmann::json and nlohmann::ordered_json alike.
[[nodiscard]] inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace isotach::reports
