// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fellin-Ostermann and Rosenbrock against CVODE along the named paths, row by row, as curves to look at.
#pragma once

#include <string>
#include <vector>

#include "verification/check.hpp"
#include "verification/named_paths.hpp"

namespace isotach::verification {

/// One row of a path by every integrator; compression positive.
struct CrossCheckRow {
  double time;          ///< s
  double axial_strain;  ///< logarithmic, of the reference
  double shear_strain;  ///< gamma_12 = 2 eps_12, of the reference
  double p_kPa;         ///< of the reference
  double q_kPa;         ///< of the reference, sqrt(3/2) |T*|, negative where the axial stress is the smaller
  double void_ratio;
  double fellin_ostermann_p_kPa;
  double fellin_ostermann_q_kPa;
  double fellin_ostermann_error;  ///< achieved error against the reference
  double rosenbrock_error;
};

struct CrossCheckCurve {
  NamedPath named;
  double tolerance;  ///< of Fellin-Ostermann and Rosenbrock
  std::vector<CrossCheckRow> rows;
  std::string failure{};  ///< what ended the curve early; empty where nothing did
};

/// All named paths: Fellin-Ostermann and Rosenbrock at a relative 1e-6, CVODE at 1e-12.
[[nodiscard]] std::vector<CrossCheckCurve> cross_check_curves();

/// Errors along each curve at most ten times the tolerance for each 0.1 of strain.
[[nodiscard]] std::vector<Check> checks_of(const std::vector<CrossCheckCurve>& curves);

}  // namespace isotach::verification
