// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/compared_slump.hpp"

#include <algorithm>

namespace isotach::reports {

EndedSlumps ended(std::span<const ComparedSlump> slumps) {
  EndedSlumps result;
  for (const ComparedSlump& slump : slumps) {
    if (slump.result) result.push_back(&slump);
  }
  return result;
}

std::vector<double> shared_times(const EndedSlumps& slumps) {
  if (slumps.empty()) return {};
  std::vector<double> times = slumps.front()->test.setup.times;
  for (const ComparedSlump* slump : slumps) {
    const std::vector<double>& own = slump->test.setup.times;
    std::erase_if(times, [&](double t) { return std::find(own.begin(), own.end(), t) == own.end(); });
  }
  return times;
}

const mpm::Outline& outline_at(const ComparedSlump& slump, std::optional<double> time) {
  const std::vector<double>& times = slump.test.setup.times;
  const auto found = time ? std::find(times.begin(), times.end(), *time) : times.end() - 1;
  return slump.result->outlines[static_cast<std::size_t>(found - times.begin())];
}

}  // namespace isotach::reports
