// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where an effect shows in slumps: a part of the outlines, while the mould rises or when it is gone.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "discovery/slump_discovery.hpp"

namespace isotach::bench {

struct OutlinePart {
  discovery::Zone zone;
  bool lifting;

  bool operator==(const OutlinePart&) const = default;
};

/// The part of that outline's zone where `left`, a value for each station of the tests, is largest.
[[nodiscard]] OutlinePart plainest_part(const discovery::SlumpTests& tests, const Eigen::VectorXd& left);

/// That of the first fitted test's outline that discovery lists; nothing where it lists none.
[[nodiscard]] std::optional<OutlinePart> first_part(
    const std::vector<discovery::SlumpDisagreement>& disagreement);

}  // namespace isotach::bench
