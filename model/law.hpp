// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The visco-hypoplastic (VHP) law: rates of stress, void ratio and anisotropy as a pure function.
#pragma once

#include <cmath>
#include <numbers>

#include "model/anisotropy.hpp"
#include "model/mandel.hpp"
#include "model/parameters.hpp"
#include "model/scalar.hpp"
#include "model/state.hpp"

namespace isotach::model {

/// Stress quantities that the law is made of, at one state.
template <class S, int N = kGeneral>
struct StressMeasures {
  S p;                     ///< mean effective pressure -tr T/3 (Pa), positive in compression
  Mandel<S, N> ratio;      ///< T*/p (-), deviatoric
  S F;                     ///< Matsuoka-Nakai factor (-), 1 in triaxial compression
  S equivalent_pressure;   ///< p_B+ (Pa), size of the ellipse through T, eq. (2)
  Mandel<S, N> direction;  ///< That = T/tr T = (1 - T*/p)/3 (-)
  Mandel<S, N> m;          ///< flow direction, unit norm, outward normal of the ellipse
};

/// |D| (1/s), with a derivative of zero where it vanishes: 1e-150 /s and below counts as nothing.
template <class S, int N>
[[nodiscard]] S norm_of(const Mandel<S, N>& strain_rate) {
  using std::sqrt;
  return sqrt(contraction<S, N>(strain_rate, strain_rate) + 1e-300);
}

/// VHP law.
///
///   T° = E : (D - D_vis - D_Hp),  D_vis = m D_r OCR^(-1/I_v),  D_Hp = C_1 m |D|,  de/dt = (1+e) tr D,
///   p_B+ = p + (3/2) |T* - p Omega|^2/(p (M^2 - (3/2) Omega:Omega)),  M = F M_c
///
/// Equations (1)-(2): Pippi, Martinelli, Tamagnini and Luger, "Simulation of a mini slump test using a
/// visco-hypoplastic constitutive model in an MPM code". Stiffness, F and a: Niemunis, "Extended hypoplastic
/// models for soils" (2003), eqs. 2.63-2.67. p_B: Butterfield's line in ln(1+e)-ln p. Rotation of Omega: see
/// rotation_rate. With Omega = 0 the ellipse is that of modified Cam Clay, p_B+ = p + q^2/(M^2 p).
///
/// Domain: p > 0, q < 3p, e > 0 and (3/2) Omega:Omega < M^2; F vanishes at q = 3p, and so does the lateral
/// stress in triaxial compression. Outside of it the results are not finite or have no meaning; callers check
/// in_domain(). At isotropic stress F is continuous but not differentiable: there its derivative is that
/// towards triaxial compression, zero.
///
/// P is the scalar of the parameters, S that of state and rates: each is double or ceres::Jet, or S any type
/// with the same arithmetic; S is P, or P is double.
template <class P>
class Law {
 public:
  explicit Law(const Parameters<P>& parameters) : parameters_(parameters) {
    using std::log;
    using std::sin;
    const P sin_phi = sin(parameters.phi_c());
    a2_ = 0.375 * (3.0 - sin_phi) * (3.0 - sin_phi) / (sin_phi * sin_phi);
    critical_ratio_ = 6.0 * sin_phi / (3.0 - sin_phi);
    inverse_critical_ratio_squared_ = 1.0 / (critical_ratio_ * critical_ratio_);
    stiffness_factor_ = 3.0 / ((1.0 + a2_ * (1.0 / 3.0)) * parameters.kappa());
    inverse_lambda_ = 1.0 / parameters.lambda();
    inverse_I_v_ = 1.0 / parameters.I_v();
    log_reference_ = std::log(kReferencePressure) + log(1.0 + parameters.e100()) * inverse_lambda_;
  }

  /// Pressure at which Butterfield's line passes e100 (Pa).
  static constexpr double kReferencePressure = 100.0e3;

  [[nodiscard]] const Parameters<P>& parameters() const { return parameters_; }
  /// a of the stiffness (-), squared.
  [[nodiscard]] const P& a_squared() const { return a2_; }
  /// M_c = q/p at the critical state in triaxial compression (-).
  [[nodiscard]] const P& critical_ratio() const { return critical_ratio_; }

  /// ln(p_B / 1 Pa) at void ratio e.
  template <class S>
  [[nodiscard]] S log_preconsolidation_pressure(const S& void_ratio) const {
    using std::log;
    return log_reference_ - log(1.0 + void_ratio) * inverse_lambda_;
  }
  /// p_B (Pa) = 100 kPa ((1+e)/(1+e100))^(-1/lambda).
  template <class S>
  [[nodiscard]] S preconsolidation_pressure(const S& void_ratio) const {
    using std::exp;
    return exp(log_preconsolidation_pressure(void_ratio));
  }
  /// Void ratio at which p_B has the value given (Pa).
  template <class S>
  [[nodiscard]] S void_ratio_at(const S& preconsolidation_pressure) const {
    using std::exp;
    using std::log;
    return exp((log_reference_ - log(preconsolidation_pressure)) * parameters_.lambda()) - 1.0;
  }

  /// Stress quantities at a state, which must be inside the domain.
  template <class S, int N, Fabric K>
  [[nodiscard]] StressMeasures<S, N> measures(const State<S, N, K>& state) const {
    StressMeasures<S, N> r;
    r.p = trace<S, N>(state.stress) * (-1.0 / 3.0);
    const S inverse_p = 1.0 / r.p;
    // T + p first: exactly zero at isotropic stress, where a rest of round-off would have a direction
    for (int i = 0; i < N; ++i) {
      r.ratio[i] =
          (i < kNormal<N> ? state.stress[i] + normal_component<N>(i, r.p) : state.stress[i]) * inverse_p;
    }
    for (int i = 0; i < N; ++i) {
      r.direction[i] =
          (i < kNormal<N> ? normal_component<N>(i, 1.0) - r.ratio[i] : -r.ratio[i]) * (1.0 / 3.0);
    }
    const S ratio2 = contraction<S, N>(r.ratio, r.ratio);
    const LodeFactor<S> lode = lode_factor<S, N>(r.ratio, ratio2);
    r.F = lode.F;
    // the ellipse in units of p: s = T*/p - Omega, A = M^2 - (3/2) Omega:Omega = M^2 (1 - (3/2)
    // Omega:Omega/M^2)
    S inverse_A = lode.inverse * lode.inverse * inverse_critical_ratio_squared_;
    S s2 = ratio2;
    Mandel<S, N> s = r.ratio;
    if constexpr (K == Fabric::omega) {
      inverse_A /= 1.0 - 1.5 * contraction<S, N>(state.omega, state.omega) * inverse_A;
      for (int i = 0; i < N; ++i) s[i] -= state.omega[i];
      s2 = contraction<S, N>(s, s);
    }
    const S excess = 1.5 * s2 * inverse_A;  // p_B+/p - 1
    r.equivalent_pressure = r.p + r.p * excess;
    S mean = (excess - 1.0) * (1.0 / 3.0);
    if constexpr (K == Fabric::omega) mean += contraction<S, N>(s, state.omega) * inverse_A;
    // |n|^2 of n = 3 s/A + mean 1, where 9 s2/A^2 = 6 excess/A
    const S inverse_norm = inverse_sqrt(6.0 * excess * inverse_A + 3.0 * mean * mean);
    const S deviatoric = 3.0 * inverse_A * inverse_norm;
    const S volumetric = mean * inverse_norm;
    for (int i = 0; i < N; ++i) {
      r.m[i] = s[i] * deviatoric;
      if (i < kNormal<N>) r.m[i] += normal_component<N>(i, volumetric);
    }
    return r;
  }

  /// Stress quantities at stress T and Omega = 0.
  template <class S, int N>
  [[nodiscard]] StressMeasures<S, N> measures(const Mandel<S, N>& stress) const {
    return measures(State<S, N, Fabric::none>{stress, S(0.0)});
  }

  /// OCR = p_B/p_B+ (eq. 2).
  template <class S, int N, Fabric K>
  [[nodiscard]] S overconsolidation_ratio(const State<S, N, K>& state) const {
    return preconsolidation_pressure(state.void_ratio) / measures(state).equivalent_pressure;
  }

  /// |D_vis| (1/s), eq. (1b), given p_B+ (Pa) and e.
  template <class S>
  [[nodiscard]] S viscous_rate(const S& equivalent_pressure, const S& void_ratio) const {
    return viscous_rate_from_logarithm(equivalent_pressure, log_preconsolidation_pressure(void_ratio));
  }
  /// The same given p_B+ (Pa) and ln(p_B / 1 Pa).
  template <class S>
  [[nodiscard]] S viscous_rate_from_logarithm(const S& equivalent_pressure, const S& log_p_B) const {
    using std::exp;
    using std::log;
    return exp((log(equivalent_pressure) - log_p_B) * inverse_I_v_) * parameters_.D_r();
  }

  /// E : X (Pa times the unit of X), E = f_b (F^2 I + a^2 That (x) That).
  template <class S, int N>
  [[nodiscard]] Mandel<S, N> stiffness_times(const StressMeasures<S, N>& at, const Mandel<S, N>& x) const {
    const S f_b = at.p * stiffness_factor_;
    const S along_x = f_b * at.F * at.F;
    const S along_direction = f_b * a2_ * contraction<S, N>(at.direction, x);
    Mandel<S, N> result;
    for (int i = 0; i < N; ++i) result[i] = x[i] * along_x + at.direction[i] * along_direction;
    return result;
  }

  /// Corotational rates under strain rate D (1/s, tension positive), eq. (1a).
  template <class S, int N, Fabric K>
  [[nodiscard]] StateRate<S, N, K> rate(const State<S, N, K>& state, const Mandel<S, N>& strain_rate) const {
    return rate(state, strain_rate, norm_of<S, N>(strain_rate));
  }

  /// The same with |D| given, which over an increment need be taken only once.
  template <class S, int N, Fabric K>
  [[nodiscard]] StateRate<S, N, K> rate(const State<S, N, K>& state, const Mandel<S, N>& strain_rate,
                                        const S& norm) const {
    return rate(state, strain_rate, norm, log_preconsolidation_pressure(state.void_ratio));
  }

  /// The same with ln(p_B / 1 Pa) given too, whose rate -tr D/lambda a caller may have integrated.
  template <class S, int N, Fabric K>
  [[nodiscard]] StateRate<S, N, K> rate(const State<S, N, K>& state, const Mandel<S, N>& strain_rate,
                                        const S& norm, const S& log_p_B) const {
    const StressMeasures<S, N> at = measures(state);
    const S viscous = viscous_rate_from_logarithm(at.equivalent_pressure, log_p_B);
    const S irreversible = viscous + norm * parameters_.C_1();
    Mandel<S, N> elastic;
    for (int i = 0; i < N; ++i) elastic[i] = strain_rate[i] - at.m[i] * irreversible;
    StateRate<S, N, K> result;
    result.stress = stiffness_times(at, elastic);
    result.void_ratio = (1.0 + state.void_ratio) * trace<S, N>(strain_rate);
    if constexpr (K == Fabric::omega) {
      result.omega =
          rotation_rate<P, S, N>(parameters_.C_2(), parameters_.C_3(), at.ratio, state.omega, viscous);
    }
    return result;
  }

  /// Whether Omega is zero and stays so: then the form without it gives the same, for less work.
  template <class S, int N>
  [[nodiscard]] bool stays_upright(const State<S, N, Fabric::omega>& state) const {
    bool zero = !parameters_.rotates();
    for (int i = 0; i < N && zero; ++i) zero = is_exactly_zero(state.omega[i]);
    return zero;
  }

  /// Whether the state is finite and inside the law's domain: p > 0, q < 3p, e > 0, (3/2) Omega:Omega < M^2.
  /// False for NaN.
  template <class S, int N, Fabric K>
  [[nodiscard]] bool in_domain(const State<S, N, K>& state) const {
    const Mandel<double, N> stress = plain<S, N>(state.stress);
    const double e = value_of(state.void_ratio);
    const double trace_of_stress = trace<double, N>(stress);
    // q < 3p is |T| < -tr T; an infinite stress is not below its own trace
    bool inside = trace_of_stress < 0.0 &&
                  contraction<double, N>(stress, stress) < trace_of_stress * trace_of_stress && e > 0.0 &&
                  e < HUGE_VAL;
    if constexpr (K == Fabric::omega) {
      const Mandel<double, N> omega = plain<S, N>(state.omega);
      const double omega2 = omega.squaredNorm();
      if (inside && omega2 != 0.0) {
        const Mandel<double, N> ratio = deviator<double, N>(stress) * (-3.0 / trace_of_stress);
        const double M =
            lode_factor<double, N>(ratio, contraction<double, N>(ratio, ratio)).F * value_of(critical_ratio_);
        inside = 1.5 * omega2 < M * M;  // false where Omega is not a number
      }
    }
    return inside;
  }

 private:
  /// Keeps square roots differentiable and quotients defined at zero.
  static constexpr double kTiny = 1e-300;

  /// F and 1/F; the latter needs neither F's difference of roots nor its quotient to be known first.
  template <class S>
  struct LodeFactor {
    S F;
    S inverse;
  };

  /// F of x = T*/p with X = |x|^2: t^2 = X/3 and sqrt2 t cos(3 theta) = 6 det(x)/X, so that
  /// F = sqrt(X/24 + Q) - sqrt(X/24) = Q/(sqrt(X/24 + Q) + sqrt(X/24)), Q = (6 - X)/(6 + 18 det(x)/X).
  template <class S, int N>
  [[nodiscard]] LodeFactor<S> lode_factor(const Mandel<S, N>& x, const S& squared_norm) const {
    using std::sqrt;
    if (parameters_.lode() == LodeDependence::none) return {S(1.0), S(1.0)};
    const S X = squared_norm + kTiny;
    const S part = X * (1.0 / 24.0);
    // det(x)/X first: a quotient of sums of order X would leave derivatives to round-off near isotropic
    // stress
    const S above = 6.0 - X;
    const S below = 6.0 + 18.0 * (determinant<S, N>(x) / X);
    const S root_of_part = sqrt(part);
    const S root = sqrt(part + above / below);
    return {root - root_of_part, (root + root_of_part) * (below / above)};
  }

  Parameters<P> parameters_;
  P a2_;
  P critical_ratio_;
  P inverse_critical_ratio_squared_;
  P stiffness_factor_;
  P inverse_lambda_;
  P inverse_I_v_;
  P log_reference_;
};

}  // namespace isotach::model
