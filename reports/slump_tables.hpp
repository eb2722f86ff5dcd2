// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the reports of simulated slumps share: how a run was set up, and how well it kept its books.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mpm/slump.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// One run with the name it has in a table.
struct NamedRun {
  std::string name;
  mpm::SlumpSetup setup;
  const mpm::SlumpResult* result;
};

/// Mould, mud and initial state, a row for each run.
[[nodiscard]] Table start_table(std::span<const NamedRun> runs);
/// Volume, energy and numerical events, a row for each run.
[[nodiscard]] Table budget_table(std::span<const NamedRun> runs);
/// The numerical method and its settings, in sentences.
[[nodiscard]] std::string numerics_text(const NamedRun& run);

/// An outline as a line of a figure in mm.
[[nodiscard]] Series outline_series(const mpm::Outline& outline, std::string label);
/// A figure in the r-z plane: axes in mm from the axis and the base, equal aspect.
[[nodiscard]] Figure meridian_figure();

/// "5 s", "0.5 s"
[[nodiscard]] std::string time_label(double seconds);

/// Indices of at most `count` of `size` things, evenly spread, the first and the last among them.
[[nodiscard]] std::vector<std::size_t> spread_indices(std::size_t size, std::size_t count);

/// The mould's wall in words: "smooth", "rough", or its limits.
[[nodiscard]] std::string words_of(const mpm::Wall& wall);

/// What the mud stands on in words: "rough", or its limits, its slip length, its slab.
[[nodiscard]] std::string words_of(const mpm::Base& base);

}  // namespace isotach::reports
