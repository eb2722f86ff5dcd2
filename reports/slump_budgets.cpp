// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/slump_budgets.hpp"

#include <fmt/format.h>

#include "reports/number.hpp"

namespace isotach::reports {

namespace {

constexpr double kVolumeErrorLimit = 0.01;  // beyond these a run is not to be trusted without a word
constexpr double kEnergyErrorLimit = 0.02;

Budget budget(const char* what, double error, double limit) {
  const bool kept = error <= limit;
  return {kept, fmt::format("{} to within {} %{}", what, format_number(100.0 * error, 2),
                            kept ? "."
                                 : fmt::format(", more than the {} % to be expected: try smaller cells.",
                                               format_number(100.0 * limit, 1)))};
}

}  // namespace

std::vector<Budget> slump_budgets(const mpm::SlumpResult& result) {
  return {budget("Volume is kept", result.volume_error, kVolumeErrorLimit),
          budget("The balance of energy closes", result.energy_error, kEnergyErrorLimit)};
}

std::vector<std::string> slump_warnings(const mpm::SlumpResult& result) {
  std::vector<std::string> warnings;
  for (const Budget& budget : slump_budgets(result)) {
    if (!budget.kept) warnings.push_back(budget.text);
  }
  return warnings;
}

}  // namespace isotach::reports
