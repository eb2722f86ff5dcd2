// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/work_precision.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace isotach::verification {

namespace {

using integrators::Method;
using Clock = std::chrono::steady_clock;

constexpr double kTimingBudget = 0.02;  // s a point
constexpr int kRepetitions = 5;
constexpr double kLongestRun = 1.0;  // s; tighter tolerances of a run this long are left out

double seconds_of(const Path& path, const Options& options) {
  const auto start = Clock::now();
  static_cast<void>(follow(path, options));
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Tightest tolerance worth drawing: beyond it explicit substeps are too many, or the reference is no better.
double tightest(Method method) {
  return method == Method::fellin_ostermann ? 1e-9 : 1e-10;
}

}  // namespace

std::vector<WorkPrecision> work_precision_study(const std::function<void(double)>& progress) {
  std::vector<WorkPrecision> study;
  const auto paths = named_paths();
  const double runs = static_cast<double>(paths.size() * integrators::kMethods.size());
  for (const NamedPath& named : paths) {
    const State exact = follow(named.path, options_of(Method::cvode, 1e-13)).value().state;
    for (const Method method : integrators::kMethods) {
      WorkPrecision curve{named, method, {}};
      for (double tolerance = method == Method::cvode ? 1e-3 : 1e-2; tolerance >= 0.9 * tightest(method);
           tolerance /= 10.0) {
        const Options options = options_of(method, tolerance);
        const auto end = follow(named.path, options);
        if (!end) continue;
        double least = std::numeric_limits<double>::infinity();
        double spent = 0.0;
        for (int i = 0; i < kRepetitions && spent < kTimingBudget; ++i) {
          const double seconds = seconds_of(named.path, options);
          least = std::min(least, seconds);
          spent += seconds;
        }
        curve.points.push_back({tolerance, achieved_error(end->state, exact), 1e6 * least, end->statistics});
        if (least > kLongestRun) break;
      }
      study.push_back(std::move(curve));
      if (progress) progress(static_cast<double>(study.size()) / runs);
    }
  }
  return study;
}

}  // namespace isotach::verification
