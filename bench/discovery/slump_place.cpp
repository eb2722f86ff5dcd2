// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/slump_place.hpp"

#include <algorithm>

#include "discovery/slump_disagreement.hpp"

namespace isotach::bench {

SlumpPlace largest_place(const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
                         const Eigen::VectorXd& left) {
  SlumpPlace place{discovery::Zone::toe, true};
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
      place = {zone, !test->mould_gone()[station.points.front()]};
    }
  }
  return place;
}

std::optional<SlumpPlace> first_place(const std::vector<discovery::SlumpDisagreement>& disagreement) {
  const auto first = std::find_if(disagreement.begin(), disagreement.end(),
                                  [](const auto& place) { return !place.held_out; });
  if (first == disagreement.end()) return std::nullopt;
  return SlumpPlace{first->zone, first->lifting};
}

}  // namespace isotach::bench
