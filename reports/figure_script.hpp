// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The gnuplot script of a figure.
#pragma once

#include <string>

#include "reports/figure.hpp"

namespace isotach::reports {

/// A script, data included, that makes gnuplot 5.4 write the figure, which must be free of contradictions, as
/// an SVG document to standard output. It starts from gnuplot's defaults, so scripts may follow one another.
[[nodiscard]] std::string figure_script(const Figure& figure);

}  // namespace isotach::reports
