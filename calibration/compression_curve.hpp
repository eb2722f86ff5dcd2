// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The compression curve of an oedometer test, ln(1+e) against ln sigma, and the straight lines drawn through
// it.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "datasets/loading_stage.hpp"

namespace isotach::calibration {

/// One point of a compression curve. Under strain control every reading; under stress control all readings of
/// each step, with the step's load as stress. The ends of steps alone do, too, but show no creep, and their
/// rate is then taken as that of the whole step.
struct CurvePoint {
  double time;          ///< s, increasing
  double axial_stress;  ///< Pa, effective, compression positive, > 0
  double void_ratio;    ///< -, > -1
  datasets::Stage stage;
  std::size_t segment;  ///< counts maximal runs of one stage from 0
};

/// A straight line ln(1+e) = intercept + slope ln(stress/1 Pa), as drawn from one stress to another.
struct Line {
  double slope;  ///< -lambda of virgin compression, -kappa0 of swelling
  double intercept;
  double from_stress;  ///< Pa, the smallest of the points it rests on
  double to_stress;    ///< Pa, the largest
  std::size_t points;  ///< >= 2

  /// ln(1+e) at a stress (Pa, > 0).
  [[nodiscard]] double at(double stress) const { return intercept + slope * std::log(stress); }
};

/// Why a construction cannot be drawn, in words for a report, or the construction.
template <class T>
using Drawn = tl::expected<T, std::string>;

/// Throws std::invalid_argument where a point's numbers are not finite or out of range, times decrease, or
/// segments do not count runs of stages.
void require_curve(std::span<const CurvePoint> curve);

/// The curve with each stretch of equal stress (a step's readings) reduced to its last point.
[[nodiscard]] std::vector<CurvePoint> without_creep(std::span<const CurvePoint> curve);

/// The points of loading beyond every stress before them: first loading, and reloading from where it passes
/// the largest stress so far.
[[nodiscard]] std::vector<CurvePoint> virgin_points(std::span<const CurvePoint> curve);

/// The line whose slope is the median of the slopes of all pairs of points, its intercept the median of what
/// remains (Theil 1950, Sen 1968): a few bad readings do not turn it. Of more than 200 points, 200 evenly
/// chosen. Needs two points of different stress.
[[nodiscard]] Drawn<Line> robust_line(std::span<const CurvePoint> points);

/// Whether a segment's points are the readings of stress-controlled steps: most have the stress of the one
/// before.
[[nodiscard]] bool stepwise(std::span<const CurvePoint> segment);

/// The virgin compression line and the rate it belongs to.
struct VirginLine {
  Line line;
  double rate;  ///< 1/s, -d ln(1+e)/dt of those points, > 0; 0 where it is unknown (steps of stress)
};

/// The virgin compression line. Virgin points are parted where the rate changes (rate_blocks), since a jump
/// of rate shifts the line; a reloading branch counts from 1.3 times the largest stress before it. Of each
/// part the upper third in ln sigma is taken, but at least a factor of 2 in stress (or all) and 3 points, and
/// at most a factor of 4; of the lines through these that span a factor of 1.5 the steepest, as the others
/// may lie below yield; where none spans that, the longest. Stress-controlled steps make one part.
[[nodiscard]] Drawn<VirginLine> virgin_line(std::span<const CurvePoint> curve);

/// The swelling line of each unloading segment that has one: through its points below 0.6 times the stress at
/// the reversal, since creep bends the first part; where that leaves one point (a single step), through it
/// and the point before the unloading. Slope negative.
[[nodiscard]] std::vector<Line> swelling_lines(std::span<const CurvePoint> curve);

/// Median of values, of which there is one at least; their order is lost.
[[nodiscard]] double median(std::vector<double>& values);

/// The law's kappa from the slope kappa0 > 0 of ln(1+e) against ln axial stress at constant K0 (> 0):
/// kappa = kappa0 [(1 + 2 K0) + a^2/(1 + 2 K0)]/(1 + a^2/3), a of the friction angle phi_c (rad) after
/// Niemunis (2003), stiffness at F = 1.
[[nodiscard]] double isotropic_swelling_index(double kappa0, double phi_c, double K0);

}  // namespace isotach::calibration
