// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fitted parameters as files and reports state them: in the units of their keys, and from which fit.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.hpp"

namespace isotach::reports {

/// A value in SI in the unit of the parameter's key.
[[nodiscard]] double in_key_unit(model::ParameterId id, double si);
/// An estimate with all of its numbers in the unit of the parameter's key.
[[nodiscard]] calibration::ParameterEstimate in_key_unit(const calibration::ParameterEstimate& estimate);

/// The parameter, in the unit of its key, that a coordinate of a fit stands for.
[[nodiscard]] double parameter_of_coordinate(model::ParameterId id, double coordinate);
/// The coordinate's name: "ln kappa", "C_1".
[[nodiscard]] std::string coordinate_name(model::ParameterId id);

/// Whether the fit moved the parameter.
[[nodiscard]] bool is_free(const calibration::FitResult& result, model::ParameterId id);
/// The estimate of one parameter.
[[nodiscard]] const calibration::ParameterEstimate& estimate_of(const calibration::FitResult& result,
                                                                model::ParameterId id);

/// All parameters in the order of ParameterId, each from the fit that moved it last: the slump's, where it
/// did, else the oedometer's, at the slump's answer.
[[nodiscard]] std::vector<calibration::ParameterEstimate> combined_estimates(
    const calibration::Calibration& calibration);

/// What the fit's gauge is and what it means for e100 and D_r, in one sentence or two.
[[nodiscard]] std::string gauge_sentence(const calibration::FitResult& result);
/// "crs-rate", "fixed" or "none", as in a study.
[[nodiscard]] std::string gauge_name(datasets::Gauge gauge);

}  // namespace isotach::reports
