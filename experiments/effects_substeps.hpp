// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Adaptive extrapolated Euler after Fellin and Ostermann for specimens with effects.
#pragma once

#include <algorithm>
#include <cmath>

#include "experiments/effects_rate.hpp"
#include "integrators/fellin_ostermann.hpp"

namespace isotach::experiments::detail {

/// y + f h.
template <class S, model::Fabric K>
[[nodiscard]] EffectsState<S, K> advanced(const EffectsState<S, K>& y, const EffectsStateRate<S, K>& f,
                                          double h) {
  return {model::advanced(y.soil, f.soil, h), y.structure + f.structure * h,
          y.held_strain + f.held_strain * h, y.elapsed + h};
}

/// a + (b - c), exactly a where b is c.
template <class S, model::Fabric K>
[[nodiscard]] EffectsStateRate<S, K> corrected(const EffectsStateRate<S, K>& a,
                                               const EffectsStateRate<S, K>& b,
                                               const EffectsStateRate<S, K>& c) {
  EffectsStateRate<S, K> result;
  for (int i = 0; i < model::kAxial; ++i) {
    result.soil.stress[i] = a.soil.stress[i] + (b.soil.stress[i] - c.soil.stress[i]);
    if constexpr (K == model::Fabric::omega) {
      result.soil.omega[i] = a.soil.omega[i] + (b.soil.omega[i] - c.soil.omega[i]);
    }
  }
  result.soil.void_ratio = a.soil.void_ratio + (b.soil.void_ratio - c.soil.void_ratio);
  result.structure = a.structure + (b.structure - c.structure);
  result.held_strain = a.held_strain + (b.held_strain - c.held_strain);
  return result;
}

/// Error of a substep tau in units of the tolerance: that of the soil as without effects, and where the law
/// heeds them that of chi against 1, and of the strain of a hold against a hundredth.
template <class S, model::Fabric K>
[[nodiscard]] double substep_error(const EffectsState<S, K>& y_half, const EffectsStateRate<S, K>& f,
                                   const EffectsStateRate<S, K>& f_half, double tau,
                                   const model::LawTerms<S>& terms, const integrators::Tolerance& tolerance) {
  constexpr double kHeldStrain = 0.01;
  double error = integrators::substep_error(y_half.soil, f.soil, f_half.soil, tau, tolerance);
  const auto heed = [&](const S& a, const S& b, double scale) {
    const double part =
        0.5 * tau * std::abs(model::value_of(a) - model::value_of(b)) / (tolerance.relative * scale);
    error = std::isnan(part) ? HUGE_VAL : std::max(error, part);
  };
  if (terms.structure) heed(f_half.structure, f.structure, 1.0);
  if (terms.delayed_creep) heed(f_half.held_strain, f.held_strain, kHeldStrain);
  return error;
}

/// Advances `y` by `duration`: over a substep tau, with F the mean rate over its second argument,
///
///   v = y + tau F(y, tau),  y_half = y + tau/2 F(y, tau/2),  w = y_half + tau/2 F(y_half, tau/2),
///
/// accepted as 2w - v where ||w - v|| is within the tolerance: where F does not depend on tau the scheme of
/// integrators::fellin_ostermann_substeps, substep by substep. `accepted(y)` is called after each. On failure
/// `y` is the last accepted state.
template <class S, model::Fabric K, class Accepted>
[[nodiscard]] tl::expected<void, integrators::Failure> follow_substeps(
    EffectsState<S, K>& y, EffectsRate<S, K>& rate, double duration, const integrators::Tolerance& tolerance,
    double& substep, Accepted&& accepted) {
  using integrators::FailureKind;
  constexpr double kSafety = 0.9;
  constexpr double kLargestGrowth = 5.0;
  constexpr double kSmallestShrink = 0.2;
  EffectsStateRate<S, K> f;
  EffectsStateRate<S, K> f_first;
  EffectsStateRate<S, K> f_half;
  const auto failure = [&](FailureKind kind) {
    return tl::unexpected(
        integrators::Failure{kind, y.elapsed, model::general(model::with_omega(model::plain(y.soil))), {}});
  };
  double proposed = substep > 0.0 ? substep : duration;
  double bound = HUGE_VAL;
  bool moved = true;
  long trials = 0;
  while (y.elapsed < duration) {
    const double left = duration - y.elapsed;
    if (moved) {
      if (!rate(y, std::min(proposed, left), f)) return failure(FailureKind::outside_domain);
      moved = false;
      bound = rate.largest_substep();
    }
    if (++trials > tolerance.max_substeps) return failure(FailureKind::too_many_substeps);
    if (!(y.elapsed + std::min(proposed, bound) > y.elapsed)) return failure(FailureKind::substep_underflow);
    const double tau = std::min(std::min(proposed, bound), left);
    f_first = f;
    if (rate.relaxes() && !(rate(y, tau, f) && rate(y, 0.5 * tau, f_first))) {
      return failure(FailureKind::outside_domain);
    }
    const EffectsState<S, K> y_half = advanced(y, f_first, 0.5 * tau);
    double error = HUGE_VAL;
    if (rate(y_half, 0.5 * tau, f_half)) {
      // w - v = tau/2 (F(y_half) + F(y, tau/2) - 2 F(y, tau))
      error = substep_error(y_half, f, corrected(f_half, f_first, f), tau, rate.terms(), tolerance) /
              tolerance.estimate_share;
    }
    if (error <= 1.0) {
      EffectsState<S, K> end = advanced(y, corrected(f_half, f_first, f), tau);
      if (rate.contains(end)) {
        if (!(tau < left)) end.elapsed = duration;
        y = end;
        accepted(y);
        moved = true;
        const double grown = tau * std::min(kLargestGrowth, kSafety / std::sqrt(std::max(error, 1e-300)));
        proposed = tau < proposed ? std::max(proposed, grown) : grown;
        continue;
      }
      error = HUGE_VAL;
    }
    const double shrink = std::isfinite(error) ? kSafety / std::sqrt(error) : 0.0;
    proposed = tau * std::max(kSmallestShrink, shrink);
  }
  substep = proposed;
  return {};
}

}  // namespace isotach::experiments::detail
