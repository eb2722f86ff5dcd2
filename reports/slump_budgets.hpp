// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a simulated slump kept of its volume and energy, in words.
#pragma once

#include <string>
#include <vector>

#include "mpm/slump.hpp"

namespace isotach::reports {

/// A quantity that should be kept.
struct Budget {
  bool kept;  ///< within what is to be expected of a sound run
  std::string text;
};

/// Volume and energy.
[[nodiscard]] std::vector<Budget> slump_budgets(const mpm::SlumpResult& result);

/// The texts of those that are not kept.
[[nodiscard]] std::vector<std::string> slump_warnings(const mpm::SlumpResult& result);

}  // namespace isotach::reports
