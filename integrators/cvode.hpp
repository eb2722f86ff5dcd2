// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Reference integration by SUNDIALS CVODE: BDF, Newton with the exact Jacobian by automatic differentiation.
#pragma once

#include <tl/expected.hpp>

#include "integrators/increment.hpp"
#include "integrators/result.hpp"

namespace isotach::integrators {

/// Tolerances of the reference integration.
struct CvodeTolerance {
  double relative = 1e-10;        ///< of each component of T and of e; absolute for strain; > 0
  double absolute_stress = 1e-6;  ///< Pa; > 0
  long max_steps = 1'000'000;
};

/// Integrates one increment of any control; steps do not restart within it.
[[nodiscard]] tl::expected<Integrated<double>, Failure> integrate_cvode(const model::Law<double>& law,
                                                                        const model::State<double>& start,
                                                                        const Increment<double>& increment,
                                                                        const CvodeTolerance& tolerance);

}  // namespace isotach::integrators
