// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/yield_stress.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/rate_blocks.hpp"

namespace isotach::calibration {

namespace {

constexpr std::size_t kFewestPoints = 5;
constexpr double kSteeper = 1.5;
constexpr double kSameRate = 2.0;       // ratio
constexpr double kSameSlope = 2.0;      // ratio
constexpr double kLowestStress = 0.01;  // of the largest

/// Slope of the part of a stretch that is beyond a stress, by its ends; 0 where there is none.
double virgin_slope(std::span<const CurvePoint> stretch, double largest_before) {
  const CurvePoint* first = nullptr;
  const CurvePoint* last = nullptr;
  for (const CurvePoint& point : stretch) {
    if (point.axial_stress <= largest_before) continue;
    if (first == nullptr) first = &point;
    if (last == nullptr || point.axial_stress > last->axial_stress) last = &point;
  }
  if (first == last) return 0.0;
  return (std::log1p(last->void_ratio) - std::log1p(first->void_ratio)) /
         std::log(last->axial_stress / first->axial_stress);
}

bool within(double a, double b, double ratio) {
  return a < ratio * b && b < ratio * a;
}

/// The curve without the stretches of loading that a jump of rate has moved: those of another rate than all
/// stretches kept before them of about their slope. Where slope and rate change together, as at yield under a
/// steadily growing load, it is no jump.
std::vector<CurvePoint> at_first_rate(std::span<const CurvePoint> curve) {
  struct Kept {
    double rate, steepness;
  };
  std::vector<Kept> kept;
  std::vector<CurvePoint> points;
  std::size_t next = 0;
  double largest = 0.0;
  for (const RateBlock& block : rate_blocks(curve)) {
    for (std::size_t i = next; i < block.first; ++i) largest = std::max(largest, curve[i].axial_stress);
    const double steepness = -virgin_slope(curve.subspan(block.first, block.count), largest);
    bool alike = false;
    bool same_rate = false;
    for (const Kept& other : kept) {
      if (!within(steepness, other.steepness, kSameSlope)) continue;
      alike = true;
      same_rate = same_rate || within(block.rate, other.rate, kSameRate);
    }
    if (alike && !same_rate) {
      // a corner between two rates is still of the first of them
      const bool shared = block.first > 0 && curve[block.first - 1].segment == curve[block.first].segment;
      const std::size_t first = std::max(next, block.first + (shared ? 1 : 0));
      for (; next < first; ++next) points.push_back(curve[next]);
      next = block.first + block.count;
    } else if (steepness > 0.0) {
      kept.push_back({block.rate, steepness});
    }
  }
  for (; next < curve.size(); ++next) points.push_back(curve[next]);
  return points;
}

/// A curve scaled to a square: x and y from 0 to 1, y downwards as compression.
struct Drawing {
  std::vector<double> x, y;
  double left, width;  ///< ln sigma
  double top, height;  ///< ln(1+e)
};

Drawing draw(const std::vector<CurvePoint>& points) {
  Drawing drawing;
  drawing.left = std::log(points.front().axial_stress);
  drawing.width = std::log(points.back().axial_stress) - drawing.left;
  drawing.top = std::log1p(points.front().void_ratio);
  drawing.height = drawing.top - std::log1p(points.back().void_ratio);
  for (const CurvePoint& point : points) {
    drawing.x.push_back((std::log(point.axial_stress) - drawing.left) / drawing.width);
    drawing.y.push_back((drawing.top - std::log1p(point.void_ratio)) / drawing.height);
  }
  return drawing;
}

/// Value and derivatives of the smoothed curve.
struct Local {
  double y, slope, bending;
};

Local smooth(const Drawing& drawing, double at) {
  constexpr double kHalfWidth = 0.15;
  std::vector<double> distances;
  for (const double x : drawing.x) distances.push_back(std::abs(x - at));
  std::nth_element(distances.begin(), distances.begin() + (kFewestPoints - 1), distances.end());
  // beyond the fifth point, which would otherwise weigh nothing
  const double half = std::max(kHalfWidth, 1.2 * distances[kFewestPoints - 1]);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < drawing.x.size(); ++i) {
    const double u = (drawing.x[i] - at) / half;
    if (std::abs(u) >= 1.0) continue;
    const double cube = 1.0 - std::abs(u * u * u);
    const Eigen::Vector3d powers(1.0, u, u * u);
    normal += cube * cube * cube * powers * powers.transpose();
    right += cube * cube * cube * drawing.y[i] * powers;
  }
  const Eigen::Vector3d c = normal.ldlt().solve(right);
  return {c[0], c[1] / half, 2.0 * c[2] / (half * half)};
}

/// The line through (x, y) of a drawing with a slope of it, in ln(1+e) and ln sigma, from x to the right end.
Line line_through(const Drawing& drawing, double x, double y, double slope) {
  const double steepness = -slope * drawing.height / drawing.width;
  const double log_stress = drawing.left + x * drawing.width;
  return {steepness, drawing.top - y * drawing.height - steepness * log_stress, std::exp(log_stress),
          std::exp(drawing.left + drawing.width), 2};
}

/// Sums of weighted least squares that grow point by point.
struct Sums {
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

struct Fit {
  double slope, intercept, misfit;
};

Fit fit(const Sums& from, const Sums& to) {
  const double w = to.w - from.w;
  const double x = (to.x - from.x) / w;
  const double y = (to.y - from.y) / w;
  const double xx = to.xx - from.xx - w * x * x;
  const double xy = to.xy - from.xy - w * x * y;
  const double slope = xy / xx;
  return {slope, y - slope * x, to.yy - from.yy - w * y * y - slope * xy};
}

std::vector<WorkPoint> work_of(const std::vector<CurvePoint>& points) {
  std::vector<WorkPoint> work{{points.front().axial_stress, 0.0}};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double strain = std::log1p(points[i - 1].void_ratio) - std::log1p(points[i].void_ratio);
    const double stress = 0.5 * (points[i - 1].axial_stress + points[i].axial_stress);
    work.push_back({points[i].axial_stress, work.back().work + stress * strain});
  }
  return work;
}

tl::unexpected<std::string> too_few(std::size_t count) {
  return tl::unexpected("too few points of virgin loading at the first rate: " + std::to_string(count) +
                        ", at least " + std::to_string(kFewestPoints) + " are needed");
}

}  // namespace

std::vector<CurvePoint> yield_points(std::span<const CurvePoint> curve) {
  std::vector<CurvePoint> points = virgin_points(at_first_rate(curve));
  if (points.empty()) return points;
  const double lowest = kLowestStress * points.back().axial_stress;
  std::erase_if(points, [lowest](const CurvePoint& point) { return point.axial_stress < lowest; });
  return points;
}

Drawn<CasagrandeYield> casagrande_yield(std::span<const CurvePoint> curve) {
  require_curve(curve);
  std::vector<CurvePoint> points = yield_points(curve);
  if (points.size() < kFewestPoints) return too_few(points.size());
  const auto virgin = virgin_line(at_first_rate(curve));
  if (!virgin) return tl::unexpected(virgin.error());
  const Drawing drawing = draw(points);
  if (!(drawing.height > 0.0)) return tl::unexpected(std::string("virgin loading does not compress"));

  constexpr int kPlaces = 100;
  constexpr int kMargin = 10;  // at its ends a smoothed curve bends as readings scatter
  int bend = 0;
  double sharpest = 0.0;
  for (int k = kMargin; k <= kPlaces - kMargin; ++k) {
    const Local local = smooth(drawing, static_cast<double>(k) / kPlaces);
    const double curvature = local.bending / std::pow(1.0 + local.slope * local.slope, 1.5);
    if (curvature > sharpest) {
      sharpest = curvature;
      bend = k;
    }
  }
  const double x = static_cast<double>(bend) / kPlaces;
  const double steepness = -virgin->line.slope * drawing.width / drawing.height;
  const Local at = smooth(drawing, x);
  if (bend == 0 || !(steepness * x > kSteeper * (at.y - drawing.y.front()))) {
    return tl::unexpected(std::string("the compression curve shows no bend towards the virgin line"));
  }
  const Line tangent = line_through(drawing, x, at.y, at.slope);
  const Line bisector = line_through(drawing, x, at.y, std::tan(0.5 * std::atan(at.slope)));
  const double log_yield =
      (bisector.intercept - virgin->line.intercept) / (virgin->line.slope - bisector.slope);
  if (!(log_yield >= drawing.left && log_yield <= drawing.left + drawing.width)) {
    return tl::unexpected(std::string("bisector and virgin line meet outside the compression curve"));
  }
  return CasagrandeYield{
      std::exp(log_yield), tangent.from_stress, drawing.top - at.y * drawing.height, tangent, bisector,
      virgin->line,        std::move(points)};
}

Drawn<BeckerYield> becker_yield(std::span<const CurvePoint> curve) {
  require_curve(curve);
  const std::vector<CurvePoint> points = yield_points(curve);
  if (points.size() < kFewestPoints) return too_few(points.size());
  std::vector<WorkPoint> work = work_of(points);
  std::vector<Sums> sums(work.size() + 1);
  for (std::size_t i = 0; i < work.size(); ++i) {
    const double x = work[i].stress;
    const double y = work[i].work;
    const double w = 1.0 / (x * x);
    const Sums& s = sums[i];
    sums[i + 1] = {s.w + w, s.x + w * x, s.y + w * y, s.xx + w * x * x, s.xy + w * x * y, s.yy + w * y * y};
  }
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t split = 2; split + 3 <= work.size(); ++split) {
    const double misfit = fit(sums.front(), sums[split]).misfit + fit(sums[split], sums.back()).misfit;
    if (misfit < least) {
      least = misfit;
      best = split;
    }
  }
  const Fit before = fit(sums.front(), sums[best]);
  const Fit after = fit(sums[best], sums.back());
  if (!(after.slope > kSteeper * before.slope)) {
    return tl::unexpected(std::string("work against stress shows no bend"));
  }
  const double yield = (before.intercept - after.intercept) / (after.slope - before.slope);
  if (!(yield >= work.front().stress && yield <= work.back().stress)) {
    return tl::unexpected(std::string("the two lines of work meet outside the compression curve"));
  }
  return BeckerYield{yield,
                     {before.slope, before.intercept, work.front().stress, work[best - 1].stress},
                     {after.slope, after.intercept, work[best].stress, work.back().stress},
                     std::move(work)};
}

}  // namespace isotach::calibration
