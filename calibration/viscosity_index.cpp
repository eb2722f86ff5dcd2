// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/viscosity_index.hpp"

#include <algorithm>
#include <optional>

#include "calibration/rate_blocks.hpp"

namespace isotach::calibration {

namespace {

constexpr double kSmallestJump = 2.0;  // ratio of rates
constexpr double kTransition = 0.004;  // of ln(1+e), beyond a jump
constexpr double kWindow = 0.03;       // of ln(1+e)
constexpr std::size_t kFewestAtRate = 4;
constexpr std::size_t kFewestInTime = 6;
constexpr double kSmallestFall = 0.01;  // of ln sigma
constexpr double kVirgin = 0.9;         // of the largest stress before: as far as an isotach may lie lower
constexpr double kNewLoad = 1.02;       // of the largest stress before
constexpr double kLateTime = 1.0 / 8.0;

/// Sums of a regression that groups of points share the slope of.
struct Group {
  double count = 0.0, mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double x, double y) {
    count += 1.0;
    const double dx = x - mean_x;
    const double dy = y - mean_y;
    mean_x += dx / count;
    mean_y += dy / count;
    xx += dx * (x - mean_x);
    xy += dx * (y - mean_y);
    yy += dy * (y - mean_y);
  }
};

double strain(const CurvePoint& point) {
  return std::log1p(point.void_ratio);
}

double largest_before(std::span<const CurvePoint> curve, std::size_t index) {
  double largest = 0.0;
  for (std::size_t i = 0; i < index; ++i) largest = std::max(largest, curve[i].axial_stress);
  return largest;
}

std::optional<RateStep> step_between(std::span<const CurvePoint> curve, const RateBlock& before,
                                     const RateBlock& after) {
  const double ratio = after.rate / before.rate;
  if (!(ratio >= kSmallestJump || ratio <= 1.0 / kSmallestJump)) return std::nullopt;
  const double jump = strain(curve[after.first]);
  const double start = strain(curve[before.first]);
  const double end = strain(curve[after.first + after.count - 1]);
  const double first_reach = std::max(0.5 * (start - jump), std::min(kWindow, 0.8 * (start - jump)));
  const double second_reach = std::max(0.5 * (jump - end), kWindow);
  Group one;
  Group two;
  for (std::size_t i = before.first; i <= after.first; ++i) {
    if (strain(curve[i]) - jump <= first_reach) one.add(strain(curve[i]), std::log(curve[i].axial_stress));
  }
  for (std::size_t i = after.first; i < after.first + after.count; ++i) {
    const double way = jump - strain(curve[i]);
    if (way >= kTransition && way <= second_reach) {
      two.add(strain(curve[i]), std::log(curve[i].axial_stress));
    }
  }
  if (one.count < kFewestAtRate || two.count < kFewestAtRate) return std::nullopt;
  const double slope = (one.xy + two.xy) / (one.xx + two.xx);
  // on the way from a reversal back to the virgin line a curve is many times steeper in stress
  const double slope_before = one.xy / one.xx;
  const double slope_after = two.xy / two.xx;
  if (!(slope < 0.0 && slope_before < 0.4 * slope && slope_before > 2.5 * slope &&
        slope_after < 0.4 * slope && slope_after > 2.5 * slope)) {
    return std::nullopt;
  }
  const double step = (two.mean_y - slope * two.mean_x) - (one.mean_y - slope * one.mean_x);
  const double I_v = step / std::log(ratio);
  if (!(I_v > 0.0)) return std::nullopt;
  return RateStep{after.first, before.rate, after.rate, step, I_v};
}

/// Least squares of value against ln(time + offset).
struct LogFit {
  double slope, intercept, misfit;
};

LogFit fit_log(std::span<const double> times, std::span<const double> values, double offset) {
  Group group;
  for (std::size_t i = 0; i < times.size(); ++i) group.add(std::log(times[i] + offset), values[i]);
  const double slope = group.xy / group.xx;
  return {slope, group.mean_y - slope * group.mean_x, group.yy - slope * group.xy};
}

/// The offset of least misfit, between a thousandth of the first and ten times the last time, by a search
/// over its logarithm: first coarse, then by golden section.
double best_offset(std::span<const double> times, std::span<const double> values) {
  const double low = std::log(1e-3 * times.front());
  const double high = std::log(10.0 * times.back());
  constexpr int kPoints = 40;
  const double step = (high - low) / (kPoints - 1);
  int best = 0;
  double least = fit_log(times, values, std::exp(low)).misfit;
  for (int k = 1; k < kPoints; ++k) {
    const double misfit = fit_log(times, values, std::exp(low + k * step)).misfit;
    if (misfit < least) {
      least = misfit;
      best = k;
    }
  }
  constexpr double kGolden = 0.6180339887498949;
  double a = low + std::max(best - 1, 0) * step;
  double b = low + std::min(best + 1, kPoints - 1) * step;
  while (b - a > 1e-6) {
    const double c = b - kGolden * (b - a);
    const double d = a + kGolden * (b - a);
    if (fit_log(times, values, std::exp(c)).misfit < fit_log(times, values, std::exp(d)).misfit) {
      b = d;
    } else {
      a = c;
    }
  }
  return std::exp(0.5 * (a + b));
}

/// Ends of the run of points that share the segment and, where asked for, the stress of `begin`.
std::size_t end_of_run(std::span<const CurvePoint> curve, std::size_t begin, bool equal_stress) {
  std::size_t end = begin + 1;
  while (end < curve.size() && curve[end].segment == curve[begin].segment &&
         (!equal_stress || curve[end].axial_stress == curve[begin].axial_stress)) {
    ++end;
  }
  return end;
}

}  // namespace

std::vector<RateStep> rate_steps(std::span<const CurvePoint> curve) {
  require_curve(curve);
  const std::vector<RateBlock> blocks = rate_blocks(curve);
  std::vector<RateStep> steps;
  for (std::size_t k = 0; k + 1 < blocks.size(); ++k) {
    const std::size_t jump = blocks[k].first + blocks[k].count - 1;
    if (blocks[k + 1].first != jump) continue;  // of another segment
    if (curve[jump].axial_stress < kVirgin * largest_before(curve, blocks[k].first)) continue;
    if (const auto step = step_between(curve, blocks[k], blocks[k + 1])) steps.push_back(*step);
  }
  return steps;
}

std::vector<TimeLine> relaxation_lines(std::span<const CurvePoint> curve) {
  require_curve(curve);
  std::vector<TimeLine> lines;
  for (std::size_t begin = 0; begin < curve.size();) {
    const std::size_t end = end_of_run(curve, begin, false);
    const bool relaxes = curve[begin].stage == datasets::Stage::relax && begin > 0 &&
                         curve[begin - 1].stage == datasets::Stage::load && end - begin >= kFewestInTime &&
                         curve[begin - 1].axial_stress >= kVirgin * largest_before(curve, begin - 1);
    if (relaxes && std::log(curve[begin - 1].axial_stress / curve[end - 1].axial_stress) > kSmallestFall) {
      std::vector<double> times;
      std::vector<double> values;
      for (std::size_t i = begin; i < end; ++i) {
        times.push_back(curve[i].time - curve[begin - 1].time);
        values.push_back(std::log(curve[i].axial_stress));
      }
      const double offset = best_offset(times, values);
      const LogFit fit = fit_log(times, values, offset);
      if (fit.slope < 0.0) {
        lines.push_back({begin, end - begin, curve[begin - 1].time, offset, -fit.slope, fit.intercept,
                         curve[end - 1].axial_stress, times.back()});
      }
    }
    begin = end;
  }
  return lines;
}

std::vector<TimeLine> creep_lines(std::span<const CurvePoint> curve) {
  require_curve(curve);
  std::vector<TimeLine> lines;
  double largest = 0.0;
  for (std::size_t begin = 0; begin < curve.size();) {
    const bool hold = curve[begin].stage == datasets::Stage::hold;
    const std::size_t end = end_of_run(curve, begin, !hold);
    const double stress = curve[begin].axial_stress;
    bool creeps = end - begin >= kFewestInTime;
    if (hold) {
      creeps = creeps && stress >= kVirgin * largest;
    } else {
      creeps = creeps && curve[begin].stage == datasets::Stage::load && stress > kNewLoad * largest &&
               stepwise(curve.subspan(begin, end_of_run(curve, begin, false) - begin));
    }
    for (std::size_t i = begin; i < end; ++i) {
      creeps = creeps && std::abs(curve[i].axial_stress - stress) <= 0.02 * stress;
      largest = std::max(largest, curve[i].axial_stress);
    }
    if (creeps) {
      // a step's first reading is taken as it is put on
      const double start = hold && begin > 0 ? curve[begin - 1].time : curve[begin].time;
      const double late = kLateTime * (curve[end - 1].time - start);
      std::size_t first = begin;
      while (first < end && curve[first].time - start < late) ++first;
      std::vector<double> times;
      std::vector<double> values;
      for (std::size_t i = first; i < end; ++i) {
        times.push_back(curve[i].time - start);
        values.push_back(strain(curve[i]));
      }
      if (times.size() >= kFewestInTime && late > 0.0) {
        const LogFit fit = fit_log(times, values, 0.0);
        if (fit.slope < 0.0) {
          lines.push_back({first, end - first, start, 0.0, -fit.slope, fit.intercept,
                           curve[end - 1].axial_stress, times.back()});
        }
      }
    }
    begin = end;
  }
  return lines;
}

}  // namespace isotach::calibration
