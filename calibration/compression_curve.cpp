// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/compression_curve.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "calibration/rate_blocks.hpp"

namespace isotach::calibration {

namespace {

constexpr std::size_t kMostPoints = 200;  // of a robust line: the pairs are as many as points squared
constexpr double kPastReload = 1.3;       // of the largest stress before a reloading
constexpr double kBelowReversal = 0.6;    // of the stress at a reversal
constexpr double kUpperPart = 1.0 / 3.0;  // in ln sigma
constexpr double kWellBelow = 0.8;        // of the largest stress before
constexpr double kSteepEnough = 0.9;      // of the steepest slope
constexpr double kLongEnough = 1.5;       // ratio of stresses
constexpr std::size_t kFewestVirgin = 3;

/// The points of a stretch of loading that virgin compression is read from, given the largest stress before.
std::vector<CurvePoint> beyond(std::span<const CurvePoint> stretch, double largest_before) {
  // a stretch that starts well below the largest stress so far comes back to the virgin line
  const bool reloading = stretch.front().axial_stress < kWellBelow * largest_before;
  std::vector<CurvePoint> points;
  double largest = reloading ? kPastReload * largest_before : 0.0;
  for (const CurvePoint& point : stretch) {
    if (point.axial_stress > largest) {
      largest = point.axial_stress;
      points.push_back(point);
    }
  }
  return points;
}

/// The part of virgin points, of increasing stress, that the virgin line goes through.
std::span<const CurvePoint> upper_part(const std::vector<CurvePoint>& points) {
  const double whole = std::log(points.back().axial_stress / points.front().axial_stress);
  const double reach = std::clamp(kUpperPart * whole, std::log(2.0), std::log(4.0));
  const double from = std::log(points.back().axial_stress) - reach - 1e-9;
  const auto first = std::find_if(points.begin(), points.end(), [from](const CurvePoint& point) {
    return std::log(point.axial_stress) >= from;
  });
  return {std::min(first, points.end() - static_cast<std::ptrdiff_t>(kFewestVirgin)), points.end()};
}

/// The lines that may be the virgin line, of which one is.
class VirginCandidates {
 public:
  void add(std::span<const CurvePoint> points, double rate) {
    if (const auto line = robust_line(points)) lines_.push_back({*line, rate});
  }
  [[nodiscard]] bool empty() const { return lines_.empty(); }
  [[nodiscard]] VirginLine best() const {
    double steepest = 0.0;
    for (const VirginLine& candidate : lines_) {
      if (span_of(candidate.line) >= kLongEnough) steepest = std::min(steepest, candidate.line.slope);
    }
    // to what stress a line goes that is steep and long; for others, less than any: how long it is
    const auto merit = [steepest](const VirginLine& candidate) {
      const Line& line = candidate.line;
      const bool qualifies = span_of(line) >= kLongEnough && line.slope <= kSteepEnough * steepest;
      return std::pair(qualifies, qualifies ? line.to_stress : span_of(line));
    };
    return *std::max_element(
        lines_.begin(), lines_.end(),
        [&merit](const VirginLine& a, const VirginLine& b) { return merit(a) < merit(b); });
  }

 private:
  static double span_of(const Line& line) { return line.to_stress / line.from_stress; }

  std::vector<VirginLine> lines_;
};

}  // namespace

void require_curve(std::span<const CurvePoint> curve) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const CurvePoint& point = curve[i];
    const bool finite =
        std::isfinite(point.time) && std::isfinite(point.axial_stress) && std::isfinite(point.void_ratio);
    const bool in_order = i == 0 || point.time > curve[i - 1].time;
    const bool counted = i == 0 || (point.stage == curve[i - 1].stage ? point.segment == curve[i - 1].segment
                                                                      : point.segment > curve[i - 1].segment);
    if (!(finite && in_order && counted && point.axial_stress > 0.0 && point.void_ratio > -1.0)) {
      throw std::invalid_argument("point " + std::to_string(i) + " of a compression curve is not admissible");
    }
  }
}

bool stepwise(std::span<const CurvePoint> segment) {
  std::size_t equal = 0;
  for (std::size_t i = 1; i < segment.size(); ++i) {
    if (segment[i].axial_stress == segment[i - 1].axial_stress) ++equal;
  }
  // a coarse load cell may read the same now and then, too
  return 2 * equal > segment.size();
}

std::vector<CurvePoint> without_creep(std::span<const CurvePoint> curve) {
  std::vector<CurvePoint> points;
  for (const CurvePoint& point : curve) {
    if (!points.empty() && points.back().axial_stress == point.axial_stress &&
        points.back().segment == point.segment) {
      points.back() = point;
    } else {
      points.push_back(point);
    }
  }
  return points;
}

std::vector<CurvePoint> virgin_points(std::span<const CurvePoint> curve) {
  std::vector<CurvePoint> points;
  double largest = 0.0;
  for (const CurvePoint& point : without_creep(curve)) {
    if (point.axial_stress <= largest) continue;
    largest = point.axial_stress;
    if (point.stage == datasets::Stage::load) points.push_back(point);
  }
  return points;
}

Drawn<Line> robust_line(std::span<const CurvePoint> points) {
  const std::size_t count = std::min(points.size(), kMostPoints);
  std::vector<double> x(count);
  std::vector<double> y(count);
  for (std::size_t i = 0; i < count; ++i) {
    const CurvePoint& point = points[count < 2 ? i : i * (points.size() - 1) / (count - 1)];
    x[i] = std::log(point.axial_stress);
    y[i] = std::log1p(point.void_ratio);
  }
  std::vector<double> slopes;
  slopes.reserve(count * count / 2);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (x[i] != x[j]) slopes.push_back((y[i] - y[j]) / (x[i] - x[j]));
    }
  }
  if (slopes.empty()) return tl::unexpected(std::string("fewer than two points of different stress"));
  const double slope = median(slopes);
  for (std::size_t i = 0; i < count; ++i) y[i] -= slope * x[i];
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return Line{slope, median(y), std::exp(*low), std::exp(*high), points.size()};
}

Drawn<VirginLine> virgin_line(std::span<const CurvePoint> curve) {
  require_curve(curve);
  VirginCandidates candidates;
  double largest = 0.0;
  std::size_t seen = 0;
  for (const RateBlock& block : rate_blocks(curve)) {
    for (; seen < block.first; ++seen) largest = std::max(largest, curve[seen].axial_stress);
    const auto points = beyond(curve.subspan(block.first, block.count), largest);
    if (points.size() >= kFewestVirgin) candidates.add(upper_part(points), block.rate);
  }
  const std::vector<CurvePoint> all = virgin_points(curve);
  if (candidates.empty() && all.size() >= kFewestVirgin) candidates.add(upper_part(all), 0.0);
  if (candidates.empty()) {
    return tl::unexpected("too few points of virgin loading: " + std::to_string(all.size()) + ", at least " +
                          std::to_string(kFewestVirgin) + " are needed");
  }
  const VirginLine best = candidates.best();
  if (!(best.line.slope < 0.0)) return tl::unexpected(std::string("virgin loading does not compress"));
  return best;
}

std::vector<Line> swelling_lines(std::span<const CurvePoint> curve) {
  require_curve(curve);
  const std::vector<CurvePoint> points = without_creep(curve);
  std::vector<Line> lines;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    while (end < points.size() && points[end].segment == points[begin].segment) ++end;
    if (points[begin].stage == datasets::Stage::unload && begin > 0) {
      const double reversal = std::max(points[begin - 1].axial_stress, points[begin].axial_stress);
      std::vector<CurvePoint> away;
      for (std::size_t i = begin; i < end; ++i) {
        if (points[i].axial_stress <= kBelowReversal * reversal) away.push_back(points[i]);
      }
      if (away.size() < 2 && end - begin < 3) away.insert(away.begin(), points[begin - 1]);
      const auto line = robust_line(away);
      if (line && line->slope < 0.0) lines.push_back(*line);
    }
    begin = end;
  }
  return lines;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double isotropic_swelling_index(double kappa0, double phi_c, double K0) {
  const double sine = std::sin(phi_c);
  if (!(kappa0 > 0.0 && std::isfinite(kappa0) && K0 > 0.0 && std::isfinite(K0) && sine > 0.0)) {
    throw std::invalid_argument("kappa0, K0 and phi_c have to be positive");
  }
  const double a = std::numbers::sqrt3 * (3.0 - sine) / (2.0 * std::numbers::sqrt2 * sine);
  const double trace = 1.0 + 2.0 * K0;
  return kappa0 * (trace + a * a / trace) / (1.0 + a * a / 3.0);
}

}  // namespace isotach::calibration
