// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Adaptive extrapolated Euler after Fellin and Ostermann (2002).
#pragma once

#include <algorithm>
#include <cmath>
#include <tl/expected.hpp>

#include "integrators/loading_rate.hpp"
#include "integrators/result.hpp"

namespace isotach::integrators {

/// Error control of one integration, per substep: the estimated errors of T, e and Omega are each held below
/// a relative part of their size and an absolute part.
struct Tolerance {
  double relative = 1e-6;            ///< of |T|, of 1+e and of 1+|Omega|; > 0
  double absolute_stress = 1e-6;     ///< Pa; >= 0
  double absolute_void_ratio = 0.0;  ///< >= 0
  double absolute_omega = 0.0;       ///< >= 0
  /// Share of the tolerance that EST may take, > 0. Where stress follows strain exponentially, with the
  /// exponent 1/kappa, the accepted solution of a path is off by (2/3) EST a step of ln|T|: at 1, the scheme
  /// as published, a path of 30 such steps misses its tolerance twentyfold. A quarter costs twice the
  /// substeps and keeps random paths of up to 0.5 of strain within ten tolerances (`isotach verify` measures
  /// it).
  double estimate_share = 0.25;
  long max_substeps = 10'000'000;  ///< accepted and rejected
};

/// Why the substeps ended early.
template <class State>
struct SubstepFailure {
  FailureKind kind;
  double time;       ///< s from the start
  State last_state;  ///< last accepted
  Statistics statistics;
};

namespace detail {

/// |difference| over `relative` (`scale` + |size|) + `absolute`.
template <int N>
[[nodiscard]] double scaled_norm(const model::Mandel<double, N>& difference,
                                 const model::Mandel<double, N>& size, double scale, double relative,
                                 double absolute) {
  return std::sqrt(model::contraction<double, N>(difference, difference)) /
         (relative * (scale + std::sqrt(model::contraction<double, N>(size, size))) + absolute);
}

/// `difference` of a state the size of w in units of the tolerance: see scaled_error.
template <int N, model::Fabric K>
[[nodiscard]] double scaled_size(const model::StateRate<double, N, K>& difference,
                                 const model::State<double, N, K>& w, const Tolerance& tolerance) {
  const double stress_error =
      scaled_norm<N>(difference.stress, w.stress, 0.0, tolerance.relative, tolerance.absolute_stress);
  const double void_ratio_error = std::abs(difference.void_ratio) /
                                  (tolerance.relative * (1.0 + w.void_ratio) + tolerance.absolute_void_ratio);
  double omega_error = 0.0;
  if constexpr (K == model::Fabric::omega) {
    omega_error =
        scaled_norm<N>(difference.omega, w.omega, 1.0, tolerance.relative, tolerance.absolute_omega);
  }
  // a NaN would slip through max(): neither compares greater
  if (std::isnan(stress_error + void_ratio_error + omega_error)) return HUGE_VAL;
  return std::max(stress_error, std::max(void_ratio_error, omega_error));
}

}  // namespace detail

/// Error of a substep in units of the tolerance: the largest of those of T, e and Omega; infinite where not a
/// number.
template <class S, int N, model::Fabric K>
[[nodiscard]] double scaled_error(const model::State<S, N, K>& w, const model::State<S, N, K>& v,
                                  const Tolerance& tolerance) {
  const auto size = model::plain(w);
  const auto other = model::plain(v);
  model::StateRate<double, N, K> difference;
  difference.stress = size.stress - other.stress;
  difference.void_ratio = size.void_ratio - other.void_ratio;
  if constexpr (K == model::Fabric::omega) difference.omega = size.omega - other.omega;
  return detail::scaled_size(difference, size, tolerance);
}

/// The same of the substep tau with the rates F(y) and F(y_half): w - v = tau/2 (F(y_half) - F(y)), formed
/// without the round-off of the difference of two states.
template <class S, int N, model::Fabric K>
[[nodiscard]] double substep_error(const model::State<S, N, K>& y_half, const model::StateRate<S, N, K>& f,
                                   const model::StateRate<S, N, K>& f_half, double tau,
                                   const Tolerance& tolerance) {
  using model::value_of;
  const double half = 0.5 * tau;
  model::State<double, N, K> w;
  model::StateRate<double, N, K> difference;
  for (int i = 0; i < N; ++i) {
    const double change = half * value_of(f_half.stress[i]);
    w.stress[i] = value_of(y_half.stress[i]) + change;
    difference.stress[i] = change - half * value_of(f.stress[i]);
    if constexpr (K == model::Fabric::omega) {
      const double turn = half * value_of(f_half.omega[i]);
      w.omega[i] = value_of(y_half.omega[i]) + turn;
      difference.omega[i] = turn - half * value_of(f.omega[i]);
    }
  }
  const double growth = half * value_of(f_half.void_ratio);
  w.void_ratio = value_of(y_half.void_ratio) + growth;
  difference.void_ratio = growth - half * value_of(f.void_ratio);
  return detail::scaled_size(difference, w, tolerance);
}

/// No bound on substeps but that of their error.
struct Unlimited {
  double operator()() const { return HUGE_VAL; }
};

/// Advances `state` by `duration` with dy/dt = rate(y); over a substep tau
///
///   v = y + tau F(y),  y_half = y + tau/2 F(y),  w = y_half + tau/2 F(y_half),  EST = ||w - v||,
///
/// accepted where EST <= TOL (times the estimate's share) as 2w - v, which is y + tau F(y_half). Step sizes
/// follow from plain values, so that with ceres::Jet the derivatives are those of the discrete map.
/// `rate(state, out)` returns false where it cannot be computed; such a trial is rejected, as is one whose
/// end point is not `inside(state)`. `midpoint(tau)` is called for each accepted substep, while y_half was
/// the last that `rate` could compute, so that integrals of what `rate` knows can be formed by the midpoint
/// rule. `largest()` bounds the substep (s) from the state that `rate` computed last; where derivatives are
/// integrated along, it has to keep the method stable: error control reacts to values only, and lets
/// derivatives grow as long as those of the round-off need to show. `substep` is the first substep to try (s;
/// 0: the duration) and returns a good next one. On failure `state` is unchanged.
///
/// Source: W. Fellin and A. Ostermann, Int. J. Numer. Anal. Meth. Geomech. 26 (2002) 1213-1233.
template <class S, int N, model::Fabric K, class Rate, class Inside, class Midpoint,
          class Largest = Unlimited>
[[nodiscard]] tl::expected<Statistics, SubstepFailure<model::State<S, N, K>>> fellin_ostermann_substeps(
    model::State<S, N, K>& state, double duration, const Tolerance& tolerance, double& substep, Rate&& rate,
    Inside&& inside, Midpoint&& midpoint, Largest&& largest = {}) {
  constexpr double kSafety = 0.9;
  constexpr double kLargestGrowth = 5.0;
  constexpr double kSmallestShrink = 0.2;
  using State = model::State<S, N, K>;

  Statistics statistics;
  if (!(duration > 0.0)) return statistics;
  double reached = 0.0;
  State y = state;
  model::StateRate<S, N, K> f;
  model::StateRate<S, N, K> f_half;
  const auto failure = [&](FailureKind kind) {
    return tl::unexpected(SubstepFailure<State>{kind, reached, y, statistics});
  };

  double proposed = substep > 0.0 ? substep : duration;
  bool moved = true;  // since f was taken
  double bound = HUGE_VAL;
  while (reached < duration) {
    if (moved) {
      ++statistics.evaluations;
      if (!rate(y, f)) return failure(FailureKind::outside_domain);
      moved = false;
      bound = largest();
    }
    if (statistics.accepted + statistics.rejected >= tolerance.max_substeps) {
      return failure(FailureKind::too_many_substeps);
    }
    if (!(reached + std::min(proposed, bound) > reached)) return failure(FailureKind::substep_underflow);
    const double left = duration - reached;
    const double tau = std::min(std::min(proposed, bound), left);

    const State y_half = advanced(y, f, 0.5 * tau);
    double error = HUGE_VAL;
    ++statistics.evaluations;
    if (rate(y_half, f_half)) {
      error = substep_error(y_half, f, f_half, tau, tolerance) / tolerance.estimate_share;
    }
    if (error <= 1.0) {
      const State end = advanced(y, f_half, tau);
      if (inside(end)) {
        midpoint(tau);
        y = end;
        moved = true;
        reached = tau < left ? reached + tau : duration;
        ++statistics.accepted;
        const double grown = tau * std::min(kLargestGrowth, kSafety / std::sqrt(std::max(error, 1e-300)));
        proposed = tau < proposed ? std::max(proposed, grown) : grown;
        continue;
      }
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

/// Fellin-Ostermann over one increment of any control. `first_substep` (s) may be 0. Where Omega is zero and
/// stays so, the result is to the last bit that of a state without Omega.
template <class S, class P, model::Fabric K>
[[nodiscard]] tl::expected<Integrated<S, K>, Failure> integrate_fellin_ostermann(
    const model::Law<P>& law, const model::State<S, model::kGeneral, K>& start, const Increment<S>& increment,
    const Tolerance& tolerance, double first_substep = 0.0) {
  if constexpr (K == model::Fabric::omega) {
    if (law.stays_upright(start)) {
      const auto upright = integrate_fellin_ostermann(law, model::in_form<model::Fabric::none>(start),
                                                      increment, tolerance, first_substep);
      if (!upright) return tl::unexpected(upright.error());
      return Integrated<S, K>{model::with_omega(upright->state), upright->strain, upright->next_substep,
                              upright->statistics};
    }
  }
  Integrated<S, K> result{start, model::Mandel<S>::Constant(S(0.0)), first_substep, {}};
  LoadingRate<S, P, K> rate(law, increment);
  using State = model::State<S, model::kGeneral, K>;
  auto substeps = fellin_ostermann_substeps(
      result.state, increment.duration, tolerance, result.next_substep,
      [&rate](const State& y, model::StateRate<S, model::kGeneral, K>& f) { return rate(y, f); },
      [&rate](const State& y) { return rate.contains(y); },
      [&](double tau) { result.strain += rate.strain_rate() * S(tau); });
  if (!substeps) {
    const auto& error = substeps.error();
    return tl::unexpected(
        Failure{error.kind, error.time, model::with_omega(model::plain(error.last_state)), error.statistics});
  }
  result.statistics = *substeps;
  return result;
}

}  // namespace isotach::integrators
