// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where an oedometer fit started: the constructions an engineer draws, and the values read off them.
#pragma once

#include <span>

#include "reports/oedometer_view.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// One line of a construction as it is drawn.
struct ConstructionLine {
  std::string name;                ///< "virgin line"
  std::vector<double> stress;      ///< kPa
  std::vector<double> void_ratio;  ///< by the height (-)
};

/// The straight lines of a test's constructions, in void ratio against stress; those that could not be drawn
/// are left out.
[[nodiscard]] std::vector<ConstructionLine> construction_lines(const calibration::Constructions& drawn);

/// The constructions on the data of each fitted test, the table of values read beside the fitted ones; says
/// that the fit started from the study's material where there are none.
void add_start_values(Page& page, const calibration::OedometerFit& fit, std::span<const TestView> views);

}  // namespace isotach::reports
