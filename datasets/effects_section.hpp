// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [effects] of a study: which effects its model has.
#pragma once

#include "datasets/oedometer.hpp"
#include "datasets/study.hpp"
#include "datasets/toml_table.hpp"
#include "effects/values.hpp"
#include "model/parameters.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::datasets {

/// Reads [effects] of `root`: name = { parameter = value, ... } for each effect that is on, in the units of
/// the keys; none where the table is absent. `material` is where defaults come from. InputError: an effect or
/// a parameter that there is none of, one missing or out of range, anisotropy beside a material that rotates.
[[nodiscard]] effects::Values<double> read_effects(TomlTable& root,
                                                   const model::Parameters<double>& material);

/// InputError where an effect needs what a test does not have. `place` is that of the test's table.
void check_effects(const effects::Values<double>& effects, const OedometerTest& test, const FilePlace& place);

/// The same of a slump test's setup.
void check_effects(const effects::Values<double>& effects, const std::string& name,
                   const mpm::SlumpSetup& setup, const FilePlace& place);

/// InputError where an element test's file has an [effects] table with anything in it: none act there.
void refuse_effects(TomlTable& root);

}  // namespace isotach::datasets
