// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Reference integration by SUNDIALS CVODES: BDF, Newton with the exact Jacobian by automatic differentiation.
#pragma once

#include <tl/expected.hpp>
#include <vector>

#include "integrators/increment.hpp"
#include "integrators/result.hpp"

namespace isotach::integrators {

/// Tolerances of the reference integration.
struct CvodeTolerance {
  double relative = 1e-10;        ///< of each component of T and of e; absolute for strain and Omega; > 0
  double absolute_stress = 1e-6;  ///< Pa; > 0
  long max_steps = 1'000'000;     ///< over the increment
};

/// Integrates one increment of any control; steps do not restart within it.
[[nodiscard]] tl::expected<Integrated<double>, Failure> integrate_cvode(const model::Law<double>& law,
                                                                        const model::State<double>& start,
                                                                        const Increment<double>& increment,
                                                                        const CvodeTolerance& tolerance);

/// The same with the states after each of `rows` equal time intervals, by the solver's own interpolation, so
/// that rows cost nothing and change no step; strain and statistics are since the start. The last row is the
/// end. std::invalid_argument where rows < 1.
[[nodiscard]] tl::expected<std::vector<Integrated<double>>, Failure> integrate_cvode_rows(
    const model::Law<double>& law, const model::State<double>& start, const Increment<double>& increment,
    int rows, const CvodeTolerance& tolerance);

}  // namespace isotach::integrators
