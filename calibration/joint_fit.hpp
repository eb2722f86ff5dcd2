// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Oedometer and slump tests under one objective, and whether they can be met together.
#pragma once

#include <memory>

#include "calibration/fit_oedometer.hpp"
#include "calibration/fit_slump.hpp"

namespace isotach::calibration {

struct JointFit {
  FitResult result;  ///< parameters of the joint answer; tests are not summarised
  std::shared_ptr<const SlumpSurrogate> surrogate;  ///< of the slumps, over all that moves
  std::size_t points = 0;                           ///< simulated for it, all slump tests at each
  std::size_t failed = 0;
  double oedometer_cost = 0.0;   ///< at the joint answer
  double oedometer_least = 0.0;  ///< of the oedometer tests alone
  double slump_cost = 0.0;       ///< at the joint answer
  double slump_least = 0.0;      ///< of the slump tests alone, moving what both kinds share
  int shared = 0;                ///< parameters that both kinds of test move
  double rise =
      0.0;  ///< of twice the cost from the two alone to the two together, in units of each one's misfit
  double p_value = 1.0;  ///< of a larger rise if one set of parameters is right for both (chi-squared)
};

struct JointFitOptions {
  int threads = 1;
  unsigned seed = 1;
  OptimiserControl control;        ///< its callback hears of simulations done
  experiments::Simulate simulate;  ///< where empty, plain_simulation()
};

/// Fits everything that either list of the study moves to all tests that are not held out. `oedometer` is the
/// fit of the oedometer tests alone, whose estimated noise is kept, `slump` that of the slump tests alone at
/// the oedometer's answer. The slumps are those of a surrogate about both answers.
[[nodiscard]] tl::expected<JointFit, FitFailure> fit_jointly(const datasets::Study& study,
                                                             const OedometerFit& oedometer,
                                                             const SlumpFit& slump,
                                                             const JointFitOptions& options);

}  // namespace isotach::calibration
