// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/outline_part.hpp"

#include <algorithm>

#include "discovery/slump_disagreement.hpp"

namespace isotach::bench {

OutlinePart plainest_part(const discovery::SlumpTests& tests, const Eigen::VectorXd& left) {
  OutlinePart part{discovery::Zone::toe, true};
  double largest = -1.0;
  Eigen::Index row = 0;
  for (const auto& test : tests) {
    const auto count = static_cast<Eigen::Index>(test->stations().size());
    const auto own = left.segment(row, count);
    row += count;
    const auto roots = discovery::roots_by_zone(*test, {own.begin(), own.end()});
    for (const experiments::OutlineStation& station : test->stations()) {
      const discovery::Zone zone = discovery::zone_of(station);
      const double root = roots[station.outline][static_cast<std::size_t>(zone)];
      if (root <= largest) continue;
      largest = root;
      part = {zone, !test->mould_gone()[station.points.front()]};
    }
  }
  return part;
}

std::optional<OutlinePart> first_part(const std::vector<discovery::SlumpDisagreement>& disagreement) {
  const auto first = std::find_if(disagreement.begin(), disagreement.end(),
                                  [](const auto& place) { return !place.held_out; });
  if (first == disagreement.end()) return std::nullopt;
  return OutlinePart{first->zone, first->lifting};
}

}  // namespace isotach::bench
