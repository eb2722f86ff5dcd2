// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The visco-hypoplastic (VHP) law, isotropic form: stress and void ratio rates as a pure function.
#pragma once

#include <cmath>
#include <numbers>

#include "model/mandel.hpp"
#include "model/parameters.hpp"
#include "model/scalar.hpp"

namespace isotach::model {

/// State of a material point.
template <class S, int N = kGeneral>
struct State {
  Mandel<S, N> stress;  ///< effective Cauchy stress T (Pa), tension positive
  S void_ratio;         ///< e (-)
};

/// Time derivative of a State, stress corotational (Jaumann) unless said otherwise.
template <class S, int N = kGeneral>
struct StateRate {
  Mandel<S, N> stress;  ///< Pa/s
  S void_ratio;         ///< 1/s
};

/// Stress quantities that the law is made of, at one stress.
template <class S, int N = kGeneral>
struct StressMeasures {
  S p;                     ///< mean effective pressure -tr T/3 (Pa), positive in compression
  Mandel<S, N> direction;  ///< That = T/tr T (-)
  S F;                     ///< Matsuoka-Nakai factor (-), 1 in triaxial compression
  S equivalent_pressure;   ///< p_B+ = p + q^2/(M^2 p) (Pa), ellipse through T, eq. (2)
  Mandel<S, N> m;          ///< flow direction, unit norm, outward normal of the ellipse
};

/// VHP law with Omega = 0.
///
///   T° = E : (D - D_vis - D_Hp),  D_vis = m D_r OCR^(-1/I_v),  D_Hp = C_1 m |D|,  de/dt = (1+e) tr D
///
/// Equations (1)-(2): Pippi, Martinelli, Tamagnini and Luger, "Simulation of a mini slump test using a
/// visco-hypoplastic constitutive model in an MPM code". Stiffness, F and a: Niemunis, "Extended hypoplastic
/// models for soils" (2003), eqs. 2.63-2.67. p_B: Butterfield's line in ln(1+e)-ln p.
///
/// Domain: p > 0, q < 3p and e > 0; F vanishes at q = 3p, and so does the lateral stress in triaxial
/// compression. Outside of it the results are not finite or have no meaning; callers check in_domain(). At
/// isotropic stress F is continuous but not differentiable: there its derivative is that towards triaxial
/// compression, zero. S is double, ceres::Jet or any type with the same arithmetic.
template <class S>
class Law {
 public:
  explicit Law(const Parameters<S>& parameters) : parameters_(parameters) {
    using std::log;
    using std::sin;
    const S sin_phi = sin(parameters.phi_c());
    a2_ = S(0.375) * (S(3.0) - sin_phi) * (S(3.0) - sin_phi) / (sin_phi * sin_phi);
    critical_ratio_ = S(6.0) * sin_phi / (S(3.0) - sin_phi);
    inverse_critical_ratio_squared_ = S(1.0) / (critical_ratio_ * critical_ratio_);
    stiffness_factor_ = S(3.0) / ((S(1.0) + a2_ * S(1.0 / 3.0)) * parameters.kappa());
    inverse_lambda_ = S(1.0) / parameters.lambda();
    inverse_I_v_ = S(1.0) / parameters.I_v();
    log_reference_ = S(std::log(kReferencePressure)) + log(S(1.0) + parameters.e100()) * inverse_lambda_;
  }

  /// Pressure at which Butterfield's line passes e100 (Pa).
  static constexpr double kReferencePressure = 100.0e3;

  [[nodiscard]] const Parameters<S>& parameters() const { return parameters_; }
  /// a of the stiffness (-), squared.
  [[nodiscard]] const S& a_squared() const { return a2_; }
  /// M = q/p at the critical state in triaxial compression (-).
  [[nodiscard]] const S& critical_ratio() const { return critical_ratio_; }

  /// ln(p_B / 1 Pa) at void ratio e.
  [[nodiscard]] S log_preconsolidation_pressure(const S& void_ratio) const {
    using std::log;
    return log_reference_ - log(S(1.0) + void_ratio) * inverse_lambda_;
  }
  /// p_B (Pa) = 100 kPa ((1+e)/(1+e100))^(-1/lambda).
  [[nodiscard]] S preconsolidation_pressure(const S& void_ratio) const {
    using std::exp;
    return exp(log_preconsolidation_pressure(void_ratio));
  }
  /// Void ratio at which p_B has the value given (Pa).
  [[nodiscard]] S void_ratio_at(const S& preconsolidation_pressure) const {
    using std::exp;
    using std::log;
    return exp((log_reference_ - log(preconsolidation_pressure)) * parameters_.lambda()) - S(1.0);
  }

  /// Stress quantities at T, which must be inside the domain.
  template <int N>
  [[nodiscard]] StressMeasures<S, N> measures(const Mandel<S, N>& stress) const {
    using std::sqrt;
    StressMeasures<S, N> r;
    const S tr = trace<S, N>(stress);
    r.p = tr * S(-1.0 / 3.0);
    const S inverse_trace = S(1.0) / tr;
    r.direction = stress * inverse_trace;
    const Mandel<S, N> dev = deviator<S, N>(stress);
    const S dev2 = dev.squaredNorm();
    S inverse_M2 = inverse_critical_ratio_squared_;
    r.F = S(1.0);
    if (parameters_.lode() == LodeDependence::matsuoka_nakai) {
      // t = sqrt3 |That*|; t cos(3 theta) = -3 sqrt18 det(That*)/|That*|^2 is smooth where t vanishes.
      const S s2 = dev2 * inverse_trace * inverse_trace;
      const S t2 = S(3.0) * s2;
      const S t = sqrt(t2 + S(kTiny));
      const Mandel<S, N> shat = dev * inverse_trace;
      const S t_cos3 = determinant<S, N>(shat) / (s2 + S(kTiny)) * S(-9.0 * std::numbers::sqrt2);
      r.F = sqrt(t2 * S(0.125) + (S(2.0) - t2) / (S(2.0) + t_cos3 * S(std::numbers::sqrt2))) -
            t * S(0.25 * std::numbers::sqrt2);
      inverse_M2 = inverse_M2 / (r.F * r.F);
    }
    const S q2 = S(1.5) * dev2;
    r.equivalent_pressure = r.p + q2 * inverse_M2 / r.p;
    Mandel<S, N> n = dev * (S(3.0) * inverse_M2);
    const S mean = (r.equivalent_pressure - S(2.0) * r.p) * S(1.0 / 3.0);
    n[0] += mean;
    n[1] += mean;
    n[2] += mean;
    r.m = n * (S(1.0) / sqrt(n.squaredNorm()));
    return r;
  }

  /// OCR = p_B/p_B+ (eq. 2).
  template <int N>
  [[nodiscard]] S overconsolidation_ratio(const State<S, N>& state) const {
    return preconsolidation_pressure(state.void_ratio) / measures<N>(state.stress).equivalent_pressure;
  }

  /// |D_vis| (1/s), eq. (1b), given p_B+ (Pa) and e.
  [[nodiscard]] S viscous_rate(const S& equivalent_pressure, const S& void_ratio) const {
    using std::exp;
    using std::log;
    return parameters_.D_r() *
           exp((log(equivalent_pressure) - log_preconsolidation_pressure(void_ratio)) * inverse_I_v_);
  }

  /// E : X (Pa times the unit of X), E = f_b (F^2 I + a^2 That (x) That).
  template <int N>
  [[nodiscard]] Mandel<S, N> stiffness_times(const StressMeasures<S, N>& at, const Mandel<S, N>& x) const {
    const S f_b = stiffness_factor_ * at.p;
    return x * (f_b * at.F * at.F) + at.direction * (f_b * a2_ * at.direction.dot(x));
  }

  /// Corotational stress rate and void ratio rate under strain rate D (1/s, tension positive), eq. (1a).
  template <int N>
  [[nodiscard]] StateRate<S, N> rate(const State<S, N>& state, const Mandel<S, N>& strain_rate) const {
    using std::sqrt;
    const StressMeasures<S, N> at = measures<N>(state.stress);
    S irreversible = viscous_rate(at.equivalent_pressure, state.void_ratio);
    irreversible += parameters_.C_1() * sqrt(strain_rate.squaredNorm() + S(kTiny));
    const Mandel<S, N> elastic = strain_rate - at.m * irreversible;
    return {stiffness_times<N>(at, elastic), (S(1.0) + state.void_ratio) * trace<S, N>(strain_rate)};
  }

  /// Whether the state is finite and inside the law's domain: p > 0, q < 3p, e > 0. False for NaN.
  template <int N>
  [[nodiscard]] static bool in_domain(const State<S, N>& state) {
    Mandel<double, N> stress;
    for (int i = 0; i < N; ++i) stress[i] = value_of(state.stress[i]);
    const double e = value_of(state.void_ratio);
    const double p = trace<double, N>(stress) / -3.0;
    const double q2 = 1.5 * deviator<double, N>(stress).squaredNorm();
    return p > 0.0 && std::isfinite(p) && q2 < 9.0 * p * p && e > 0.0 && std::isfinite(e);
  }

 private:
  /// Keeps square roots differentiable and quotients defined at zero; 1e-150 and below counts as nothing.
  static constexpr double kTiny = 1e-300;

  Parameters<S> parameters_;
  S a2_;
  S critical_ratio_;
  S inverse_critical_ratio_squared_;
  S stiffness_factor_;
  S inverse_lambda_;
  S inverse_I_v_;
  S log_reference_;
};

}  // namespace isotach::model
