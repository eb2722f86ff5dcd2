// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What measured outlines hold against what the mould held: the one error of theirs that can be measured.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "experiments/slump_experiment.hpp"

namespace isotach::calibration {

/// Volume inside a measured outline over that of the fill, minus one.
[[nodiscard]] double volume_excess(const datasets::SlumpTest& test, const datasets::Outline& outline);
/// Its mean over a test's outlines.
[[nodiscard]] double volume_excess(const datasets::SlumpTest& test);

/// By how much (m) a measured outline lies too far out if what it holds too much is spread evenly over its
/// surface; negative where it holds too little.
[[nodiscard]] double offset_by_volume(const datasets::SlumpTest& test, const datasets::Outline& outline);

/// That offset of all outlines of the tests, as residuals see it, stacked. A scale, an edge or an axis that
/// is off is so in all tests of one set-up: more outlines do not average it out.
[[nodiscard]] Eigen::VectorXd direction_of_volume(
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests);

}  // namespace isotach::calibration
