// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The substepping scheme as the seed paper prints it, slip by slip. Wrong on purpose: only the verification
// report uses it, to show by measurement that the slips are slips.
#pragma once

#include "verification/path.hpp"

namespace isotach::verification {

/// Which of the printed equations are taken literally; the others are as in Fellin and Ostermann (2002).
struct PrintedSlips {
  /// (5a): w = y_half + tau/2 F(y) + tau/2 F(y_half), which advances by 1.5 tau, and 2w - v by 2 tau.
  bool modified_euler = false;
  /// The substep is rejected where TOL > EST, and so accepted where EST >= TOL.
  bool rejection = false;
  /// (6b): tau_new = tau min{5, 0.9 sqrt(TOL/EST), dt - tau}, a minimum over ratios and a time. What is left
  /// of the increment still caps the substep, or the increment would not end.
  bool step_size = false;
};

/// What came of an increment.
struct PrintedResult {
  State state;
  double
      advanced;  ///< ln((1+e)/(1+e_0)) over its value tr D dt: the share of the increment that was advanced
  long accepted = 0;
  long rejected = 0;
  bool finished = true;      ///< false where the limit of substeps was reached or the law's domain was left
  double largest_EST = 0.0;  ///< of accepted substeps, relative to |w|
};

/// `n` equal substeps without error control over a strain-driven increment.
[[nodiscard]] PrintedResult printed_fixed(const Law& law, const State& start,
                                          const Increment<double>& increment, int n, PrintedSlips slips);

/// Adaptive substeps with the relative tolerance; `seconds_per_unit` is the unit in which time is counted,
/// which only matters where a time is compared with a ratio.
[[nodiscard]] PrintedResult printed_adaptive(const Law& law, const State& start,
                                             const Increment<double>& increment, double tolerance,
                                             PrintedSlips slips, double seconds_per_unit = 1.0,
                                             long max_substeps = 200'000);

}  // namespace isotach::verification
