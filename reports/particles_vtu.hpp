// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The material points of a slump for ParaView.
#pragma once

#include <vector>

#include "mpm/slump.hpp"
#include "reports/output_directory.hpp"

namespace isotach::reports {

/// Writes "particles/frame_001.vtu" and so on, one for each snapshot, and the collection "particles.pvd" with
/// their times (s), which is what to open in ParaView. tests/consumer/particles_in_vtk.py reads them with
/// VTK.
///
/// A frame is a VTK UnstructuredGrid of vertices at (r, z, 0) in m with Float64 point data, base64 inline.
/// The unit is in the name of each; stresses and pressures are compression positive.
///   velocity_m_per_s (r, z, 0), effective_stress_Pa (rr, zz, hoop, rz), mean_effective_pressure_Pa,
///   deviatoric_stress_q_Pa, pore_pressure_Pa, void_ratio, overconsolidation_ratio,
///   strain_rate_norm_per_s (|D| of the last step, volumetric part averaged over cells)
///
/// Throws OutputError where a file cannot be written.
void write_particles(OutputDirectory& output, const std::vector<mpm::Snapshot>& snapshots);

}  // namespace isotach::reports
