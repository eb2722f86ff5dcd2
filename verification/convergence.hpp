// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Observed orders of convergence with their intervals, and the printed slips measured.
#pragma once

#include <string>
#include <vector>

#include "verification/check.hpp"
#include "verification/path.hpp"

namespace isotach::verification {

/// An order fitted to errors over step sizes in logarithms, with its 95 % interval (Student's t).
struct ObservedOrder {
  double order;
  double half_width;
};

/// Slope of ln(error) over ln(step); at least three pairs, all positive.
[[nodiscard]] ObservedOrder fit_order(const std::vector<double>& step, const std::vector<double>& error);

/// Errors of one scheme at a sequence of step sizes.
struct Convergence {
  std::string scheme;
  std::string meaning;
  std::vector<double> step;   ///< strain |D| tau of a substep, the mean of it where the scheme chooses
  std::vector<double> error;  ///< |dT|/|T| at the end of the path
  ObservedOrder order;
  double expected;   ///< order that the scheme should have, for the corrected ones; NaN where none is claimed
  double tolerance;  ///< of the order
};

/// One adaptive run of the scheme with a slip.
struct SlipRun {
  std::string variant;
  double tolerance;
  std::string time_unit;
  double error;     ///< max(|dT|/|T|, |de|) at the end
  double advanced;  ///< share of the increment
  long accepted;
  long rejected;
  bool finished;
};

/// All of it.
struct ConvergenceStudy {
  Path path;
  std::vector<Convergence> schemes;
  std::vector<SlipRun> slips;
  std::vector<double> est_step;     ///< strain of the substep
  std::vector<double> est_correct;  ///< EST of one substep as it should be, order 2
  std::vector<double> est_printed;  ///< EST of one substep by (5a), order 1
  ObservedOrder est_correct_order;
  ObservedOrder est_printed_order;
};

[[nodiscard]] ConvergenceStudy convergence_study();

/// Corrected schemes within their tolerance of their order; the printed ones of order 0, advancing twice.
[[nodiscard]] std::vector<Check> checks_of(const ConvergenceStudy& study);

}  // namespace isotach::verification
