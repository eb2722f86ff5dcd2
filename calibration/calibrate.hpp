// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The main job: oedometer fit, slump fit, both at once; or both in turn until they stand still.
#pragma once

#include <functional>

#include "calibration/fit_oedometer.hpp"
#include "calibration/fit_slump.hpp"
#include "calibration/joint_fit.hpp"

namespace isotach::calibration {

/// One round of the chain.
struct CalibrationRound {
  model::Parameters<double> after_oedometer;  ///< with which the round began
  model::Parameters<double> after_slump;      ///< or after the joint fit
};

struct Calibration {
  OedometerFit first_oedometer;   ///< with what the study lets it move, before any slump was seen
  SlumpFit slump_alone;           ///< the first slump fit, of everything the study lets the slump move
  OedometerFit oedometer;         ///< the last: at the slump's I_v
  SlumpFit slump;                 ///< the last, of what the oedometer does not move, and I_v
  std::optional<JointFit> joint;  ///< both kinds of test at once
  std::string joint_failure;      ///< why there is none
  bool I_v_is_joint = false;      ///< both kinds of test hold I_v, and the answer's is that of the joint fit
  std::vector<CalibrationRound> rounds;
  bool settled = false;  ///< the last round moved nothing that matters
};

struct CalibrateOptions {
  int threads = 1;        ///< of the oedometer fits
  int slump_threads = 1;  ///< of the slump fits: simulations asked for at once
  int max_rounds = 4;
  const std::atomic<bool>* stop = nullptr;
  experiments::Simulate simulate;  ///< of slump tests; where empty, mpm::run_slump until `stop`
  /// Fraction of the expected work done, and what is being done.
  std::function<void(double, const std::string&)> progress;
};

/// Needs at least one fitted test of each kind. A parameter that both fits may move: I_v is that of the joint
/// fit where the oedometer holds it too, and the slump's where it does not; then both fits go on in turn. Any
/// other (C_1, which a slump hardly sees) is the slump's only in the first slump fit, which shows how well
/// the slump holds it, and the oedometer's from then on.
[[nodiscard]] tl::expected<Calibration, FitFailure> calibrate(const datasets::Study& study,
                                                              const CalibrateOptions& options);

}  // namespace isotach::calibration
