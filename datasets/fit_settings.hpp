// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [fit], [fit.bounds] and [fit.prior] of a study.
#pragma once

#include "datasets/study.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {

/// Reads [fit] of `root`; the defaults of FitSettings where it is absent. `material` is where the fit starts.
/// `effects` are those that are on, whose parameters ("ring_friction.mu") oedometer and slump may list too,
/// each those of its tests; slump may list OCR0 and e0.
/// InputError: an unknown parameter, one listed twice, one of an effect that is off, an unknown gauge, bounds
/// that are not [lower, upper] within the admissible range, a fitted parameter that starts outside of its
/// bounds, a prior that is not { mean, std_error } or is on a parameter that fit-oedometer does not move,
/// counts out of range.
[[nodiscard]] FitSettings read_fit(TomlTable& root, const model::Parameters<double>& material,
                                   const effects::Values<double>& effects = {});

/// InputError where [fit] slump moves OCR0 or e0 and the tests do not state it, state different values, or
/// one outside of its bounds.
void check_free_mud(const Study& study);

}  // namespace isotach::datasets
