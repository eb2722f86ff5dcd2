// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/primary_consolidation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace isotach::experiments {

namespace {

struct Line {
  double slope;
  double intercept;
};

/// Least-squares line through points first .. last - 1.
Line fit_line(std::span<const double> x, std::span<const double> y, std::size_t first, std::size_t last) {
  const auto count = static_cast<double>(last - first);
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    products += (x[i] - mean_x) * (y[i] - mean_y);
    squares += (x[i] - mean_x) * (x[i] - mean_x);
  }
  const double slope = squares > 0.0 ? products / squares : 0.0;
  return {slope, mean_y - slope * mean_x};
}

/// Strains since `from`, turned so that the last is positive.
std::vector<double> growing(std::span<const double> strains, double from) {
  const double sign = strains.back() >= from ? 1.0 : -1.0;
  std::vector<double> result;
  for (const double strain : strains) result.push_back(sign * (strain - from));
  return result;
}

constexpr std::size_t kFewest = 8;  // readings a construction is tried with
constexpr std::size_t kEarly = 4;   // of them on the straight part

}  // namespace

tl::expected<double, std::string> end_of_primary_taylor(std::span<const double> times,
                                                        std::span<const double> strains, double before) {
  if (times.size() < kFewest) {
    return tl::unexpected(fmt::format("{} readings are too few for Taylor's construction", times.size()));
  }
  std::vector<double> root;
  for (const double time : times) root.push_back(std::sqrt(time));
  const std::vector<double> strain = growing(strains, before);
  const double total = strain.back();
  // The straight part reaches to 60 % of primary compression; a third of all compression is inside of it for
  // any creep that follows less than half of it. The first readings may still hold bedding.
  std::size_t last = 0;
  while (last < strain.size() && strain[last] <= total / 3.0) ++last;
  if (last < kEarly) {
    return tl::unexpected(std::string(
        "the readings begin too late for Taylor's construction: a third of the compression was over"));
  }
  const Line line = fit_line(root, strain, 0, last);
  if (!(line.slope > 0.0)) return tl::unexpected(std::string("the early readings do not compress"));
  const double slope_90 = line.slope / 1.15;
  for (std::size_t i = last; i < strain.size(); ++i) {
    if (strain[i] - line.intercept > slope_90 * root[i]) continue;
    // between readings i - 1 and i the curve crosses the second line
    const double gap_before = strain[i - 1] - line.intercept - slope_90 * root[i - 1];
    const double gap_behind = strain[i] - line.intercept - slope_90 * root[i];
    const double share =
        gap_before > gap_behind ? std::clamp(gap_before / (gap_before - gap_behind), 0.0, 1.0) : 1.0;
    const double strain_90 = strain[i - 1] + share * (strain[i] - strain[i - 1]);
    const double strain_100 = line.intercept + (strain_90 - line.intercept) / 0.9;
    for (std::size_t k = i; k < strain.size(); ++k) {
      if (strain[k] >= strain_100) return times[k];
    }
    return tl::unexpected(std::string("primary compression goes on until the last reading"));
  }
  return tl::unexpected(std::string("the curve never leaves its straight part in sqrt(t)"));
}

tl::expected<double, std::string> end_of_primary_casagrande(std::span<const double> times,
                                                            std::span<const double> strains) {
  if (times.size() < kFewest) {
    return tl::unexpected(fmt::format("{} readings are too few for Casagrande's construction", times.size()));
  }
  std::vector<double> log_time;
  for (const double time : times) log_time.push_back(std::log(time));
  const std::vector<double> strain = growing(strains, strains.front());
  // the tangent at the inflection is the steepest line over a third of a decade or so of readings
  const double window = std::log(10.0) / 3.0;
  Line steepest{0.0, 0.0};
  std::size_t where = 0;
  for (std::size_t first = 0; first < strain.size(); ++first) {
    std::size_t last = first;
    while (last < strain.size() && log_time[last] - log_time[first] <= window) ++last;
    if (last - first < 3) continue;
    const Line line = fit_line(log_time, strain, first, last);
    if (line.slope > steepest.slope) {
      steepest = line;
      where = last;
    }
  }
  // the final straight part: the last half decade
  std::size_t tail = strain.size() - 1;
  while (tail > 0 && log_time.back() - log_time[tail - 1] <= 0.5 * std::log(10.0)) --tail;
  if (strain.size() - tail < 3 || where >= tail) {
    return tl::unexpected(std::string("no straight part follows the inflection in ln(t)"));
  }
  const Line final_part = fit_line(log_time, strain, tail, strain.size());
  if (!(steepest.slope > 1.5 * final_part.slope)) {
    return tl::unexpected(std::string("the curve in ln(t) has no inflection followed by a flatter part"));
  }
  const double end =
      std::exp((final_part.intercept - steepest.intercept) / (steepest.slope - final_part.slope));
  if (!(end > times.front() && end < times.back())) {
    return tl::unexpected(std::string("the two lines in ln(t) meet outside of the readings"));
  }
  return end;
}

}  // namespace isotach::experiments
