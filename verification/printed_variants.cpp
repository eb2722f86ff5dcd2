// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/printed_variants.hpp"

#include <algorithm>
#include <cmath>

#include "integrators/fellin_ostermann.hpp"

namespace isotach::verification {

namespace {

struct Trial {
  State accepted;  // 2w - v
  double EST;      // relative to |w|
  bool inside;
};

Trial try_substep(const Law& law, const State& y, const Vector6& strain_rate, double tau,
                  PrintedSlips slips) {
  const auto f = law.rate(y, strain_rate);
  const State half = advanced(y, f, 0.5 * tau);
  if (!law.in_domain(half)) return {y, HUGE_VAL, false};
  const auto f_half = law.rate(half, strain_rate);
  const State v = advanced(y, f, tau);
  State w = advanced(half, f_half, 0.5 * tau);
  if (slips.modified_euler) w = advanced(w, f, 0.5 * tau);
  State end;
  end.stress = 2.0 * w.stress - v.stress;
  end.void_ratio = 2.0 * w.void_ratio - v.void_ratio;
  integrators::Tolerance one;
  one.relative = 1.0;
  one.absolute_stress = 0.0;
  return {end, integrators::scaled_error(w, v, one), law.in_domain(end)};
}

void finish(PrintedResult& result, const State& start, const Increment<double>& increment) {
  const double exact = model::trace<double, 6>(increment.strain_rate) * increment.duration;
  result.advanced = std::log((1.0 + result.state.void_ratio) / (1.0 + start.void_ratio)) / exact;
}

}  // namespace

PrintedResult printed_fixed(const Law& law, const State& start, const Increment<double>& increment, int n,
                            PrintedSlips slips) {
  PrintedResult result{start, 0.0};
  for (int i = 0; i < n && result.finished; ++i) {
    const Trial trial = try_substep(law, result.state, increment.strain_rate, increment.duration / n, slips);
    result.finished = trial.inside;
    if (!trial.inside) break;
    result.state = trial.accepted;
    result.largest_EST = std::max(result.largest_EST, trial.EST);
    ++result.accepted;
  }
  finish(result, start, increment);
  return result;
}

PrintedResult printed_adaptive(const Law& law, const State& start, const Increment<double>& increment,
                               double tolerance, PrintedSlips slips, double seconds_per_unit,
                               long max_substeps) {
  PrintedResult result{start, 0.0};
  const double duration = increment.duration;
  double reached = 0.0;
  double tau = duration;
  while (reached < duration) {
    const double left = duration - reached;
    if (result.accepted + result.rejected >= max_substeps || tau < 1e-15 * duration) {
      result.finished = false;
      break;
    }
    const double step = std::min(tau, left);
    const Trial trial = try_substep(law, result.state, increment.strain_rate, step, slips);
    const double ratio = 0.9 * std::sqrt(tolerance / std::max(trial.EST, 1e-300));
    const bool accept = slips.rejection ? !(tolerance > trial.EST) : trial.EST <= tolerance;
    if (accept && trial.inside) {
      result.state = trial.accepted;
      result.largest_EST = std::max(result.largest_EST, trial.EST);
      reached = step < left ? reached + step : duration;
      ++result.accepted;
      double factor = std::min(5.0, ratio);
      if (slips.step_size) factor = std::min(factor, (duration - step) / seconds_per_unit);
      tau = step * factor;
    } else {
      ++result.rejected;
      tau = step * std::max(0.2, std::isfinite(trial.EST) ? ratio : 0.0);
    }
  }
  finish(result, start, increment);
  return result;
}

}  // namespace isotach::verification
