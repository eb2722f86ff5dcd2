// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The yield (preconsolidation) stress of a compression curve by Casagrande's and by Becker's construction.
#pragma once

#include <span>
#include <vector>

#include "calibration/compression_curve.hpp"

namespace isotach::calibration {

/// The points both constructions use: virgin points at the rate of the first loading (stretches of about the
/// same slope, but twice the rate or half, are left out: a jump of rate would look like a bend), above a
/// hundredth of the largest stress, as below load cells read coarsely and specimens seat.
[[nodiscard]] std::vector<CurvePoint> yield_points(std::span<const CurvePoint> curve);

/// Casagrande's (1936) construction, drawn in ln(1+e) against ln sigma, where virgin compression is straight.
struct CasagrandeYield {
  double yield_stress;  ///< Pa, where bisector and virgin line meet
  double bend_stress;   ///< Pa, of the point of greatest curvature
  double bend;          ///< ln(1+e) of that point on the smoothed curve
  Line tangent;         ///< there; as the bisector drawn from the bend to the end of the curve
  Line bisector;        ///< of tangent and horizontal
  Line virgin;
  std::vector<CurvePoint> points;  ///< the yield points
};

/// The curve through the yield points is smoothed by local parabolas (tricube weights over 15 % of the drawn
/// width to either side, or as far as five points need), and its curvature taken in a drawing as wide as
/// high: curvature and bisector depend on the drawing, and that is the customary one.
///
/// Cannot be drawn with fewer than 5 yield points, without a virgin line, without a bend inside the curve (a
/// tenth of the width from its ends at least, the virgin line steeper by half than the chord from the
/// curve's start to the bend), or where the lines meet outside the curve's stresses.
[[nodiscard]] Drawn<CasagrandeYield> casagrande_yield(std::span<const CurvePoint> curve);

/// Work per volume done on the soil up to a stress.
struct WorkPoint {
  double stress;  ///< Pa
  double work;    ///< J/m3, from the first point on
};

/// A straight line work = intercept + slope stress.
struct WorkLine {
  double slope;      ///< -
  double intercept;  ///< J/m3
  double from_stress;
  double to_stress;
};

/// The work method of Becker, Crooks, Been & Jefferies (1987): work against stress bends at yield.
struct BeckerYield {
  double yield_stress;  ///< Pa, where the two lines meet
  WorkLine before;
  WorkLine after;
  std::vector<WorkPoint> points;
};

/// Work is summed over the yield points by the trapezoidal rule of stress over -ln(1+e), so that both
/// branches of a curve that is bilinear in ln(1+e) against ln sigma are straight. Of all partings into two
/// branches (two points before, three after, at least) the two least-squares lines of smallest misfit are
/// taken, deviations relative to stress: a straight edge laid by eye follows low stresses as well.
///
/// Cannot be drawn with fewer than 5 yield points, where the second line is not steeper by half than the
/// first, or where they meet outside the curve's stresses.
[[nodiscard]] Drawn<BeckerYield> becker_yield(std::span<const CurvePoint> curve);

}  // namespace isotach::calibration
