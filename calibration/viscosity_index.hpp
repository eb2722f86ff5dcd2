// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The viscosity index I_v as read off a compression curve: from jumps of rate, relaxation and creep.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/compression_curve.hpp"

namespace isotach::calibration {

/// A jump of rate in virgin loading.
struct RateStep {
  std::size_t index;        ///< of the last point at the first rate
  double rate_before;       ///< 1/s, -d ln(1+e)/dt
  double rate_after;        ///< 1/s
  double logarithmic_step;  ///< ln(sigma after/sigma before) at equal void ratio
  double I_v;               ///< of it over ln(rate after/rate before)
};

/// Jumps by a factor of at least 2 between neighbouring stretches of rate, both in virgin compression. Two
/// parallel lines ln sigma = c - s ln(1+e) through the stretches give the step at equal void ratio; of the
/// first stretch its last half (in ln(1+e)) counts, of the second what lies 0.004 beyond the jump, up to its
/// half or 0.03, whichever is more: the way between two isotachs is elastic and short. At least 4 points
/// each.
[[nodiscard]] std::vector<RateStep> rate_steps(std::span<const CurvePoint> curve);

/// A straight line against the logarithm of time, value = intercept - slope ln((t - begin + offset)/1 s).
struct TimeLine {
  std::size_t first;  ///< index of its first point in the curve
  std::size_t count;
  double begin;   ///< s, the last reading before it, or the first at that stress
  double offset;  ///< s, >= 0
  double slope;   ///< > 0
  double intercept;
  double stress;    ///< Pa, axial, at its last point
  double duration;  ///< s, from `begin` to its last point
};

/// Each relaxation (stage relax, strain held) from virgin loading: value ln(sigma/1 Pa), whose slope is I_v.
/// Viscous strain alone unloads the stress then: sigma = sigma_0 (1 + t/offset)^-I_v. The offset is found by
/// least squares. At least 6 points and a fall of 1 %.
[[nodiscard]] std::vector<TimeLine> relaxation_lines(std::span<const CurvePoint> curve);

/// Each creep under constant stress (a step's readings, or a stage hold with its stress within 2 %) in virgin
/// loading: value ln(1+e), slope C_alpha = lambda I_v. Through the readings after an eighth of the time, when
/// pore pressures of the step are gone; offset 0. At least 6 points.
[[nodiscard]] std::vector<TimeLine> creep_lines(std::span<const CurvePoint> curve);

}  // namespace isotach::calibration
