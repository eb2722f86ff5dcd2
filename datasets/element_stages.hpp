// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The stages of an element test file, those that repeat written out.
#pragma once

#include <vector>

#include "datasets/toml_table.hpp"
#include "integrators/element_test.hpp"

namespace isotach::datasets {

/// Rows that all stages of a file may have together, and stages after repeated ones are written out.
inline constexpr long kMaxElementRows = 1'000'000;
inline constexpr long kMaxElementStages = 20'000;

/// The [[stage]] tables of `root`, at least one, in SI and tension positive.
///
/// A stage has duration_s and optionally name ("stage 2"), rows (100), first_row_s, strain_rate_per_s,
/// strain, stress_rate_kPa_per_s, stress_kPa, mean_stress and spin_per_s; or it is `repeat` times its own
/// [[stage.stage]], which become stages named "<name> <cycle>: <name of the stage within>". A component that
/// no key names is held at zero strain rate. InputError as for read_element_file.
[[nodiscard]] std::vector<integrators::Stage> read_element_stages(TomlTable& root);

}  // namespace isotach::datasets
