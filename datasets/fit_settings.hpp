// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [fit] and [fit.bounds] of a study.
#pragma once

#include "datasets/study.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {

/// Reads [fit] of `root`; the defaults of FitSettings where it is absent. `material` is where the fit starts.
/// InputError: an unknown parameter, one listed twice, an unknown gauge, bounds that are not [lower, upper]
/// within the admissible range, a fitted parameter that starts outside of its bounds.
[[nodiscard]] FitSettings read_fit(TomlTable& root, const model::Parameters<double>& material);

}  // namespace isotach::datasets
