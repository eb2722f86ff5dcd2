// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The figures of an element test, as its stages call for them.
#pragma once

#include <string>
#include <vector>

#include "reports/element_result.hpp"
#include "reports/figure.hpp"

namespace isotach::reports {

/// A figure with the names that its curves have as CSV.
struct ElementFigure {
  std::string name;   ///< of the file, without ending
  std::string x_key;  ///< column, with its unit
  std::string y_key;
  Figure figure;
};

/// Figures under one heading, in pairs side by side.
struct ElementFigures {
  std::string heading;
  std::vector<ElementFigure> figures;
};

/// Stress and strain; paths in p-q, with the critical state and the ellipse through the initial p_B, and in
/// e-ln p, with the line of p_B; stress, strain, void ratio and OCR in time; and holds in the logarithm of
/// their time. Needs at least two rows.
[[nodiscard]] std::vector<ElementFigures> element_figures(const datasets::ElementFile& test,
                                                          const ElementCurve& curve);

}  // namespace isotach::reports
