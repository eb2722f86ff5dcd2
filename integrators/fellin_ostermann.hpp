// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Adaptive extrapolated Euler after Fellin and Ostermann (2002).
#pragma once

#include <algorithm>
#include <cmath>
#include <tl/expected.hpp>

#include "integrators/increment.hpp"
#include "integrators/result.hpp"

namespace isotach::integrators {

/// Error control of one integration.
struct Tolerance {
  double relative = 1e-6;         ///< of |T| and of 1+e, per substep; > 0
  double absolute_stress = 1e-6;  ///< Pa, added to the relative part; >= 0
  long max_substeps = 10'000'000;
};

/// Why the substeps ended early.
template <class S, int N>
struct SubstepFailure {
  FailureKind kind;
  double time;                    ///< s from the start
  model::State<S, N> last_state;  ///< last accepted
};

/// Error of a substep in units of the tolerance: the larger of those of T and e; infinite where not a number.
template <class S, int N>
[[nodiscard]] double scaled_error(const model::State<S, N>& w, const model::State<S, N>& v,
                                  const Tolerance& tolerance) {
  double difference2 = 0.0;
  double size2 = 0.0;
  for (int i = 0; i < N; ++i) {
    const double d = model::value_of(w.stress[i]) - model::value_of(v.stress[i]);
    const double s = model::value_of(w.stress[i]);
    difference2 += d * d;
    size2 += s * s;
  }
  const double stress_error =
      std::sqrt(difference2) / (tolerance.relative * std::sqrt(size2) + tolerance.absolute_stress);
  const double void_ratio = model::value_of(w.void_ratio);
  const double void_ratio_error =
      std::abs(void_ratio - model::value_of(v.void_ratio)) / (tolerance.relative * (1.0 + void_ratio));
  // a NaN would slip through max(): neither compares greater
  if (std::isnan(stress_error) || std::isnan(void_ratio_error)) return HUGE_VAL;
  return std::max(stress_error, void_ratio_error);
}

/// Advances `state` by `duration` with dy/dt = rate(y); over a substep tau
///
///   v = y + tau F(y),  y_half = y + tau/2 F(y),  w = y_half + tau/2 F(y_half),  EST = ||w - v||,
///
/// accepted where EST <= TOL as 2w - v, which is y + tau F(y_half). Step sizes follow from plain values, so
/// that with ceres::Jet the derivatives are those of the discrete map. `rate(state, out)` returns false where
/// it cannot be computed; such a trial is rejected. `midpoint(tau)` is called for each substep to be
/// accepted, while y_half was the last that `rate` could compute, so that integrals of what `rate` knows can
/// be formed by the midpoint rule; should the end point turn out to lie outside the domain, midpoint(-tau)
/// takes that back. `substep` is the first substep to try (s; 0: the duration) and returns a good next one.
/// On failure `state` is unchanged.
///
/// Source: W. Fellin and A. Ostermann, Int. J. Numer. Anal. Meth. Geomech. 26 (2002) 1213-1233.
template <class S, int N, class Rate, class Midpoint>
[[nodiscard]] tl::expected<Statistics, SubstepFailure<S, N>> fellin_ostermann_substeps(
    model::State<S, N>& state, double duration, const Tolerance& tolerance, double& substep, Rate&& rate,
    Midpoint&& midpoint) {
  constexpr double kSafety = 0.9;
  constexpr double kLargestGrowth = 5.0;
  constexpr double kSmallestShrink = 0.2;
  constexpr double kSmallestSubstep = 1e-15;  // of the duration: below this time no longer advances

  Statistics statistics;
  if (!(duration > 0.0)) return statistics;
  double reached = 0.0;
  model::State<S, N> y = state;
  model::StateRate<S, N> f;
  model::StateRate<S, N> f_half;
  const auto failure = [&](FailureKind kind) {
    return tl::unexpected(SubstepFailure<S, N>{kind, reached, y});
  };
  ++statistics.evaluations;
  if (!rate(y, f)) return failure(FailureKind::outside_domain);

  double proposed = substep > 0.0 ? substep : duration;
  while (reached < duration) {
    if (statistics.accepted + statistics.rejected >= tolerance.max_substeps) {
      return failure(FailureKind::too_many_substeps);
    }
    if (proposed < kSmallestSubstep * duration) return failure(FailureKind::substep_underflow);
    const double left = duration - reached;
    const double tau = std::min(proposed, left);

    const model::State<S, N> y_half{y.stress + f.stress * S(0.5 * tau),
                                    y.void_ratio + f.void_ratio * S(0.5 * tau)};
    double error = HUGE_VAL;
    ++statistics.evaluations;
    if (rate(y_half, f_half)) {
      const model::State<S, N> v{y.stress + f.stress * S(tau), y.void_ratio + f.void_ratio * S(tau)};
      const model::State<S, N> w{y_half.stress + f_half.stress * S(0.5 * tau),
                                 y_half.void_ratio + f_half.void_ratio * S(0.5 * tau)};
      error = scaled_error(w, v, tolerance);
    }
    if (error <= 1.0) {
      midpoint(tau);
      const model::State<S, N> accepted{y.stress + f_half.stress * S(tau),
                                        y.void_ratio + f_half.void_ratio * S(tau)};
      model::StateRate<S, N> f_next;
      ++statistics.evaluations;
      if (rate(accepted, f_next)) {
        y = accepted;
        f = f_next;
        reached = tau < left ? reached + tau : duration;
        ++statistics.accepted;
        const double grown = tau * std::min(kLargestGrowth, kSafety / std::sqrt(std::max(error, 1e-300)));
        proposed = tau < proposed ? std::max(proposed, grown) : grown;
        continue;
      }
      midpoint(-tau);  // the end point is outside the domain: the substep is taken back
      error = HUGE_VAL;
    }
    ++statistics.rejected;
    const double shrink = std::isfinite(error) ? kSafety / std::sqrt(error) : 0.0;
    proposed = tau * std::max(kSmallestShrink, shrink);
  }
  state = y;
  substep = proposed;
  return statistics;
}

/// Fellin-Ostermann over one increment of any control. `first_substep` (s) may be 0.
template <class S>
[[nodiscard]] tl::expected<Integrated<S>, Failure> integrate_fellin_ostermann(const model::Law<S>& law,
                                                                              const model::State<S>& start,
                                                                              const Increment<S>& increment,
                                                                              const Tolerance& tolerance,
                                                                              double first_substep = 0.0) {
  Integrated<S> result{start, model::Mandel<S>::Constant(S(0.0)), first_substep, {}};
  LoadingRate<S> rate(law, increment);
  auto substeps = fellin_ostermann_substeps<S, model::kGeneral>(
      result.state, increment.duration, tolerance, result.next_substep,
      [&rate](const model::State<S>& y, model::StateRate<S>& f) { return rate(y, f); },
      [&](double tau) { result.strain += rate.strain_rate() * S(tau); });
  if (!substeps) {
    Failure failure{substeps.error().kind, substeps.error().time, plain(substeps.error().last_state)};
    return tl::unexpected(failure);
  }
  result.statistics = *substeps;
  return result;
}

}  // namespace isotach::integrators
