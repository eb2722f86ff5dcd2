// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A simulated slump as one of several, and what several have in common.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "datasets/slump_file.hpp"
#include "mpm/slump.hpp"

namespace isotach::reports {

/// A slump file and what came of it.
struct ComparedSlump {
  std::string name;  ///< of its results: unique and safe as a file name
  datasets::SlumpFile test;
  tl::expected<mpm::SlumpResult, mpm::SlumpFailure> result;
};

/// Slumps that have a result; they live as long as what they were taken from.
using EndedSlumps = std::vector<const ComparedSlump*>;

[[nodiscard]] EndedSlumps ended(std::span<const ComparedSlump> slumps);

/// Output times that all have (s), increasing; none where there are no slumps.
[[nodiscard]] std::vector<double> shared_times(const EndedSlumps& slumps);

/// The outline at one of the slump's output times (s), by default its last.
[[nodiscard]] const mpm::Outline& outline_at(const ComparedSlump& slump, std::optional<double> time);

}  // namespace isotach::reports
