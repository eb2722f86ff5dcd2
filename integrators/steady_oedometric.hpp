// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The steady state of oedometric compression at constant rate: stress ratio and viscous strain rate.
#pragma once

#include <ceres/jet.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <tl/expected.hpp>

#include "model/law.hpp"

namespace isotach::integrators {

/// Steady oedometric compression: every stress grows in proportion to p_B, so that K0 and OCR stay constant,
/// and so does Omega, at C_3 T*/p (at zero where C_2 = 0).
template <class S>
struct SteadyOedometric {
  S K0;            ///< lateral to axial effective stress (-), in (0, 1)
  S viscous_rate;  ///< |D_vis| (1/s), > 0; OCR = (|D_vis|/D_r)^(-I_v)
};

namespace detail {

/// How far a trial K0 is from steady oedometric compression.
template <class S>
struct SteadyTrial {
  S irreversible;  ///< y = |D_vis|/r + C_1 (-), from the axial condition
  S residual;      ///< of the lateral condition (-), positive where K0 is too small
};

/// With D = -r diag(1, 0, 0) and T = -sigma_a diag(1, K0, K0) growing as p_B, that is at the rate r/lambda,
/// eq. (1a) reads E : (D - m y r) = (r/lambda) T. E is proportional to sigma_a and has T as an eigenvector,
/// (E:T) = w T. So with x = sigma_a/(lambda w), below kappa/lambda, the axial condition is m_a y = x - 1, the
/// lateral m_r y = x K0. As |m_a| < 1, the axial one gives y > 1 - kappa/lambda > C_1, hence |D_vis| > 0. The
/// residual m_r y - x K0 is positive at K0 = 0 and negative where m_r = 0, hence a steady state always
/// exists where Omega = 0.
template <class S>
[[nodiscard]] SteadyTrial<S> steady_trial(const model::Law<S>& law, const S& K0) {
  model::Mandel<S, model::kPlane> stress;  // 1 = axial, sigma_a = 1 Pa
  stress << S(-1.0), -K0, -K0, S(0.0);
  model::State<S, model::kPlane> state{stress, S(0.0)};
  if (law.parameters().rotates()) {
    // steady: T*/p stays, viscous flow goes on, so that Omega has reached C_3 T*/p
    state.omega = law.measures(stress).ratio * law.parameters().C_3();
  }
  const auto at = law.measures(state);
  const S w = -law.stiffness_times(at, stress)[0];
  const S x = S(1.0) / (law.parameters().lambda() * w);
  const S y = (x - S(1.0)) / at.m[0];
  return {y, at.m[1] * y - x * K0};
}

}  // namespace detail

/// Steady oedometric compression at the axial strain rate r = `axial_strain_rate` (1/s, compression, > 0).
/// e100, I_v and D_r do not enter; K0 does not depend on r, |D_vis| is proportional to it.
///
/// S may be a ceres::Jet: the iteration runs on plain values, and one Newton step in S from its end makes the
/// derivatives exact (implicit function theorem).
///
/// Fails where r is not positive and finite, or should round-off keep the iteration from converging.
template <class S>
[[nodiscard]] tl::expected<SteadyOedometric<S>, std::string> steady_oedometric(
    const model::Parameters<S>& parameters, double axial_strain_rate) {
  using Jet = ceres::Jet<double, 1>;
  constexpr int kMaxIterations = 100;
  constexpr double kTolerance = 1e-10;  // Newton's method squares it in the last step
  if (!(axial_strain_rate > 0.0 && std::isfinite(axial_strain_rate))) {
    return tl::unexpected(fmt::format("axial strain rate {} 1/s is not admissible; accepted: > 0 and finite",
                                      axial_strain_rate));
  }

  // With Omega = C T*/p, m_r > 0 where q/p is beyond the positive root of (q/p)^2 + 3 (1 - C) q/p = M^2, and
  // the ellipse exists where C q/p < M.
  const model::Law<Jet> plain_law(parameters.template cast<Jet>());
  const double M = model::value_of(plain_law.critical_ratio());
  const double C = parameters.rotates() ? model::value_of(parameters.C_3()) : 0.0;
  const auto K0_at = [](double q_over_p) { return (3.0 - q_over_p) / (3.0 + 2.0 * q_over_p); };
  double low = 3.0 * C < M ? 0.0 : K0_at(M / C);
  double high = K0_at(0.5 * (std::sqrt(9.0 * (1.0 - C) * (1.0 - C) + 4.0 * M * M) - 3.0 * (1.0 - C)));
  double K0 = 0.5 * (low + high);
  double slope = 0.0;
  constexpr double kSmallResidual = 1e-8;  // a root, not an end of the bracket
  bool converged = false;
  for (int iteration = 0; iteration < kMaxIterations && !converged; ++iteration) {
    const Jet residual = detail::steady_trial(plain_law, Jet(K0, 0)).residual;
    (residual.a > 0.0 ? low : high) = K0;
    slope = residual.v[0];
    double next = K0 - residual.a / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    converged = std::abs(next - K0) <= kTolerance * K0 && std::abs(residual.a) <= kSmallResidual;
    K0 = next;
  }
  if (!converged) return tl::unexpected(fmt::format("no steady K0 found; last tried {:.6g}", K0));

  const model::Law<S> law(parameters);
  const S exact_K0 = S(K0) - detail::steady_trial(law, S(K0)).residual * S(1.0 / slope);
  const S viscous = detail::steady_trial(law, exact_K0).irreversible - parameters.C_1();
  return SteadyOedometric<S>{exact_K0, viscous * S(axial_strain_rate)};
}

}  // namespace isotach::integrators
