// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Every curve that a report draws, as plain CSV.
#pragma once

#include "calibration/calibrate.hpp"
#include "reports/output_directory.hpp"

namespace isotach::reports {

// Files are named after the tests; characters of a name that are not safe in file names become "_", and a
// number follows where two names would become one.

/// What write_oedometer_curves writes, and curves/oedometer_convergence.csv: route, evaluation, cost and the
/// coordinates' quantities.
void write_curves(OutputDirectory& output, const calibration::OedometerFit& fit);

/// For each test curves/slump/<test>_outlines.csv (simulated: time_s, r_mm, z_mm, as the data format) and
/// curves/slump/<test>_distances.csv (measured points: time_s, r_mm, z_mm, distance_mm, positive where the
/// simulated mud reaches beyond the measured surface, distance_in_noise, mould_gone: 1 from when the rim had
/// left the mud); curves/slump_convergence.csv.
void write_curves(OutputDirectory& output, const calibration::SlumpFit& fit);

/// The curves of both fits.
void write_curves(OutputDirectory& output, const calibration::Calibration& calibration);

/// Outlines in the format of a study's data: time_s, r_mm, z_mm.
void write_outlines(OutputDirectory& output, const std::string& name,
                    const std::vector<mpm::Outline>& outlines);

/// outlines.csv (as the data format) and history.csv: time_s, height_mm, toe_mm, kinetic_J, potential_J,
/// stress_work_J, boundary_work_J, volume_mm3, inertia_scaling. In a folder of the output ("test-1/"), or in
/// the output itself.
void write_curves(OutputDirectory& output, const mpm::SlumpResult& result, const std::string& folder = {});

}  // namespace isotach::reports
