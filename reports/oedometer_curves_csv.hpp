// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The curves of an oedometer fit's figures as CSV.
#pragma once

#include "calibration/fit_oedometer.hpp"
#include "reports/output_directory.hpp"

namespace isotach::reports {

/// For each test:
/// - curves/oedometer/<test>.csv, a row a reading: time_s, axial_strain, void_ratio, stage,
///   measured_stress_kPa, fitted_stress_kPa, fitted_strain (of the model, compression positive), quantity
///   ("stress" or "strain": what is compared; empty where nothing is), residual_in_noise, whitened_residual;
/// - curves/oedometer_isotachs/<test>.csv: rate_per_s, axial_stress_kPa, void_ratio;
/// and, where the fit started from constructions on it,
/// - curves/oedometer_constructions/<test>.csv: line, axial_stress_kPa, void_ratio;
/// - curves/oedometer_work/<test>.csv, of Becker's method: axial_stress_kPa, work_kJ_per_m3.
/// Where the fit was assessed, curves/oedometer_profiles.csv: parameter, value, rise (of twice the cost),
/// threshold; curves/oedometer_starts.csv: kind ("start", "answer") and the coordinates' quantities.
void write_oedometer_curves(OutputDirectory& output, const calibration::OedometerFit& fit);

}  // namespace isotach::reports
