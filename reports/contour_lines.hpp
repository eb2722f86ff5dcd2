// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Lines of equal value of numbers on a grid.
#pragma once

#include <Eigen/Core>
#include <span>

#include "reports/figure.hpp"

namespace isotach::reports {

/// The line along which `values` (a row for each x, a column for each y) equal `level`, linear between the
/// grid's points, as one series whose pieces a NaN parts. Cells with a corner that is not finite have none.
[[nodiscard]] Series contour_line(std::span<const double> x, std::span<const double> y,
                                  const Eigen::MatrixXd& values, double level);

}  // namespace isotach::reports
