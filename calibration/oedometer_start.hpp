// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The start of an oedometer fit: the constructions an engineer would draw, on the tests of a study.
#pragma once

#include <memory>
#include <vector>

#include "calibration/parametrisation.hpp"
#include "calibration/start_values.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::calibration {

/// The compression curve of a test as it was measured: every reading of a strain-controlled one, the last
/// reading under each load of a stress-controlled one.
[[nodiscard]] std::vector<CurvePoint> compression_curve_of(
    const experiments::OedometerExperiment& experiment);

/// Constructions on the tests that are not held out. e100 is read at `reference_rate` (1/s, axial); where
/// that is 0, at the rate at which D_r of `material` is steady.
[[nodiscard]] StartValues start_values_of(
    const std::vector<std::shared_ptr<const experiments::OedometerExperiment>>& experiments,
    const model::Parameters<double>& material, double reference_rate);

/// The parametrisation's start with what the constructions give in its place, inside the bounds.
[[nodiscard]] std::vector<double> start_from(const StartValues& values,
                                             const Parametrisation& parametrisation);

}  // namespace isotach::calibration
