// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The head that result.json of every command begins with.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "reports/run_info.hpp"

namespace isotach::reports {

/// "command", "version", "status", "seconds", "input", and "warnings": those of the run, then those given.
[[nodiscard]] nlohmann::ordered_json result_head(const RunInfo& run, std::string_view status,
                                                 const std::vector<std::string>& warnings = {});

}  // namespace isotach::reports
