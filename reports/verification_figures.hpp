// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The figures of the verification report.
#pragma once

#include <vector>

#include "reports/figure.hpp"
#include "verification/verification.hpp"

namespace isotach::reports {

/// Error over the substep's strain of every scheme, the printed one among them.
[[nodiscard]] Figure convergence_figure(const verification::ConvergenceStudy& study);
/// EST of one substep over its strain, as it should be and as printed.
[[nodiscard]] Figure estimate_figure(const verification::ConvergenceStudy& study);
/// Share of random paths with an error above a multiple of the tolerance.
[[nodiscard]] Figure error_distribution_figure(const verification::RandomPathStudy& study);
/// Error over path length, a dot a path.
[[nodiscard]] Figure error_over_length_figure(const verification::RandomPathStudy& study);
/// Share of increments whose tangent is off by more than so much.
[[nodiscard]] Figure tangent_figure(const verification::TangentStudy& study);
/// A named path by two integrators: stress path, or void ratio or mean stress over time.
[[nodiscard]] Figure cross_check_figure(const verification::CrossCheckCurve& curve);
/// Errors along the named paths.
[[nodiscard]] Figure cross_check_error_figure(const std::vector<verification::CrossCheckCurve>& curves);
/// Evaluations, or time, against achieved error on one named path by every integrator.
[[nodiscard]] Figure work_figure(const std::vector<verification::WorkPrecision>& work,
                                 const std::string& path, bool time);

/// Shares above: for sorted values, x the value and y the share of all that is larger, thinned to few
/// hundred.
struct Survival {
  std::vector<double> value;
  std::vector<double> share;
};
[[nodiscard]] Survival survival(const std::vector<double>& sorted);

}  // namespace isotach::reports
