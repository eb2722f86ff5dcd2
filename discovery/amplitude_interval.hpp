// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How well tests know the amplitude of an effect that is added.
#pragma once

#include <vector>

#include "calibration/profile.hpp"
#include "discovery/candidate.hpp"
#include "discovery/slump_candidate.hpp"

namespace isotach::discovery {

/// SI.
struct AmplitudeInterval {
  const effects::Effect* effect = nullptr;
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  calibration::ProfileEnd lower_end = calibration::ProfileEnd::open;  ///< what ends it
  calibration::ProfileEnd upper_end = calibration::ProfileEnd::open;
};

/// The level of intervals that are reported.
inline constexpr double kIntervalLevel = 0.95;

/// For each added effect the amplitudes that the candidate's fit does not exclude at `level`, between 0 and
/// 1, by profile likelihood: amplitude and shape trade off along a bend that no standard error follows. By
/// the noise of the fit, which counts as known to so many degrees of freedom (Student's t).
[[nodiscard]] std::vector<AmplitudeInterval> amplitude_intervals(
    const datasets::Study& study, const Candidate& candidate, double level, int threads,
    const calibration::OptimiserControl& control);

/// The same of slump tests by linearisation at the candidate's answer, where a profile would take hundreds of
/// simulations. `variance` is that of its residuals.
[[nodiscard]] std::vector<AmplitudeInterval> amplitude_intervals(const SlumpCandidate& candidate,
                                                                 double variance, double level);

}  // namespace isotach::discovery
