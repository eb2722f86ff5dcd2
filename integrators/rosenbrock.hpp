// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Linearly implicit (Rosenbrock) integration of long, stiff increments.
#pragma once

#include <tl/expected.hpp>

#include "integrators/fellin_ostermann.hpp"

namespace isotach::integrators {

/// Integrates one increment of any control by the Rosenbrock method RODAS5P (rosenbrock_tableau.hpp) with the
/// exact Jacobian, taken once a step: creep over years or I_v of 0.01 cost some tens of substeps.
///
/// The tolerance holds per substep as for Fellin-Ostermann, and holds the strain too, to `relative` times
/// 1 + |strain|; the global error is about the tolerance or below it (README.md has measured ones). Substeps
/// follow Gustafsson's predictive control (Hairer and Wanner II, section IV.8). An infinite or very large
/// tolerance takes the whole increment in one substep, with an error of order 5. `first_substep` (s) may be
/// 0, for one chosen from the rate and its time derivative at the start. An increment of zero duration
/// returns the state unchanged.
[[nodiscard]] tl::expected<Integrated<double>, Failure> integrate_rosenbrock(
    const model::Law<double>& law, const model::State<double>& start, const Increment<double>& increment,
    const Tolerance& tolerance, double first_substep = 0.0);

}  // namespace isotach::integrators
