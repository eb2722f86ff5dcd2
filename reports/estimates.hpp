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

/// A parameter of an effect, or a quantity of a test's start, with all of its numbers in the unit of its
/// name.
[[nodiscard]] calibration::LocalEstimate in_key_unit(const calibration::LocalEstimate& estimate);

/// The quantity that a coordinate of a fit stands for at x: a parameter in the unit of its key, or one of a
/// test's start.
[[nodiscard]] double quantity_at(const calibration::Coordinate& coordinate, double x);
/// The coordinate's name: "ln kappa", "C_1", "ln crs-1: OCR".
[[nodiscard]] std::string coordinate_name(const calibration::Coordinate& coordinate);
/// The quantity's name with its unit, if it has one: "D_r (1/s)", "seating.delta_m", "crs-1: K0".
[[nodiscard]] std::string quantity_name(const calibration::Coordinate& coordinate);
/// The quantity's name in files: "D_r_per_s", "crs-1: K0".
[[nodiscard]] std::string quantity_key(const calibration::Coordinate& coordinate);
/// The names of all coordinates.
[[nodiscard]] std::vector<std::string> coordinate_names(const calibration::FitResult& result);

/// Whether the fit moved the parameter.
[[nodiscard]] bool is_free(const calibration::FitResult& result, model::ParameterId id);
/// The estimate of one parameter.
[[nodiscard]] const calibration::ParameterEstimate& estimate_of(const calibration::FitResult& result,
                                                                model::ParameterId id);

/// All parameters in the order of ParameterId, each from the fit that moved it last: the slump's, where it
/// did, else the oedometer's, at the slump's answer; I_v the joint fit's, where both kinds of test hold it.
[[nodiscard]] std::vector<calibration::ParameterEstimate> combined_estimates(
    const calibration::Calibration& calibration);

/// What the fit's gauge is and what it means for e100 and D_r, in one sentence or two.
[[nodiscard]] std::string gauge_sentence(const calibration::FitResult& result);
/// "crs-rate", "fixed" or "none", as in a study.
[[nodiscard]] std::string gauge_name(datasets::Gauge gauge);

}  // namespace isotach::reports
