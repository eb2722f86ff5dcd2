// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The paths that curves, cross-checks and work-precision diagrams share, and the parameter sets they use.
#pragma once

#include <string>
#include <vector>

#include "verification/path.hpp"

namespace isotach::verification {

/// Set A of the reference numbers, with another C_1, I_v, C_2 and C_3 where given.
[[nodiscard]] model::Parameters<double> set_a(double C_1 = 0.0, double I_v = 0.05, double C_2 = 0.0,
                                              double C_3 = 0.0);

/// The mud of the seed's final set (Table 4).
[[nodiscard]] model::Parameters<double> seed_mud();

/// A path to look at.
struct NamedPath {
  Path path;
  std::string meaning;  ///< one sentence
  bool stiff;           ///< creep or relaxation, or OCR to a high power
  bool over_time;       ///< drawn over time (holds), else over axial strain
};

/// All of them.
[[nodiscard]] std::vector<NamedPath> named_paths();

}  // namespace isotach::verification
