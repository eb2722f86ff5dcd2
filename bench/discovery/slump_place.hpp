// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where an effect shows in slumps: a part of the outlines, while the mould rises or when it is gone.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "discovery/slump_discovery.hpp"

namespace isotach::bench {

struct SlumpPlace {
  discovery::Zone zone;
  bool lifting;

  bool operator==(const SlumpPlace&) const = default;
};

/// The place of that outline's zone where `left`, a value for each station of the tests, is largest.
[[nodiscard]] SlumpPlace largest_place(
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
    const Eigen::VectorXd& left);

/// That of the first fitted test's outline that discovery lists; nothing where it lists none.
[[nodiscard]] std::optional<SlumpPlace> first_place(
    const std::vector<discovery::SlumpDisagreement>& disagreement);

}  // namespace isotach::bench
