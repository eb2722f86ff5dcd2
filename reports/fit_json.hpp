// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The parts of result.json that all fits share.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "calibration/fit_result.hpp"

namespace isotach::reports {

/// Every parameter under its name, in the unit of its key: value, unit, std_error, ci95, verdict, words.
[[nodiscard]] nlohmann::ordered_json parameters_json(
    const std::vector<calibration::ParameterEstimate>& estimates);
/// The same of the parameters of effects that a fit moved, under "ring_friction.mu".
[[nodiscard]] nlohmann::ordered_json shared_estimates_json(
    const std::vector<calibration::LocalEstimate>& estimates);
/// One number for each coordinate, under its name ("ln kappa"); null where there is none.
[[nodiscard]] nlohmann::ordered_json by_coordinate(const calibration::FitResult& result,
                                                   std::span<const double> numbers);
/// The quantities that coordinates stand for, under their keys ("D_r_per_s").
[[nodiscard]] nlohmann::ordered_json quantities_json(const calibration::FitResult& result,
                                                     std::span<const double> coordinates);
/// How one route ended and what it found.
[[nodiscard]] nlohmann::ordered_json route_json(const calibration::FitResult& result,
                                                const calibration::OptimiserResult& route);
/// What all fits have in common.
[[nodiscard]] nlohmann::ordered_json fit_json(const calibration::FitResult& result);
/// How a test is met.
[[nodiscard]] nlohmann::ordered_json test_json(const calibration::TestSummary& test);

}  // namespace isotach::reports
