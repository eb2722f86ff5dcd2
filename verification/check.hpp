// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One comparison of a computed number with what it must be.
#pragma once

#include <cmath>
#include <string>

namespace isotach::verification {

/// A number against its expected value. Passes where |got - expected| <= tolerance; not where either is NaN.
struct Check {
  std::string group;       ///< which study
  std::string name;        ///< what, in words, with the unit
  std::string integrator;  ///< and its tolerance; empty where none is involved
  double expected = 0.0;
  double got = 0.0;
  double tolerance = 0.0;  ///< absolute, in the unit of the number
  std::string note{};      ///< where expected comes from, or why the tolerance is what it is

  [[nodiscard]] bool pass() const { return std::abs(got - expected) <= tolerance; }
};

}  // namespace isotach::verification
