// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the tests of the law and its integration share: parameter set A of the reference numbers, states and
// rates given compression positive in kPa, and p and q.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "integrators/integrate.hpp"
#include "model/published_sets.hpp"

namespace isotach::tests {

using Law = model::Law<double>;
using State = model::State<double>;
using Vector6 = model::Mandel<double>;

using model::set_a_values;

/// Set A with another C_1.
inline model::Parameters<double> set_a(double C_1 = 0.0) {
  auto values = set_a_values();
  values[model::ParameterId::C_1] = C_1;
  return model::Parameters<double>::create(values).value();
}

/// Stress (Pa, tension positive, Mandel) from principal stresses in kPa, compression positive.
inline Vector6 stress_kPa(double s11, double s22, double s33) {
  Vector6 t;
  t << -s11, -s22, -s33, 0.0, 0.0, 0.0;
  return t * 1e3;
}

/// Strain rate (1/s, tension positive, Mandel) from principal rates, compression positive.
inline Vector6 compression_rate(double d11, double d22, double d33) {
  Vector6 d;
  d << -d11, -d22, -d33, 0.0, 0.0, 0.0;
  return d;
}

/// p in kPa.
inline double p_kPa(const State& state) {
  return -state.stress.head<3>().sum() / 3e3;
}

/// sigma_11 - sigma_22 in kPa, compression positive: q of a triaxial test with axis 1, with its sign.
inline double q_kPa(const State& state) {
  return (state.stress[1] - state.stress[0]) / 1e3;
}

/// End state of a strain-driven increment; throws where the integration fails.
inline State strained(const Law& law, const State& start, const Vector6& strain_rate, double duration,
                      const integrators::Options& options) {
  return integrators::integrate(law, start, integrators::strain_increment<double>(strain_rate, duration),
                                options)
      .value()
      .state;
}

/// Tolerances for comparisons with reference numbers. Fellin-Ostermann's global error is about proportional
/// to the tolerance (integrators_fellin_ostermann_test measures it) and costs tolerance^-1/2.
inline integrators::Options tight(integrators::Method method) {
  integrators::Options options;
  options.method = method;
  options.fellin_ostermann.relative = 1e-10;
  options.rosenbrock.relative = 1e-12;
  options.cvode.relative = 1e-12;
  options.cvode.absolute_stress = 1e-8;
  return options;
}

/// The method's name as one of a test: letters only.
inline std::string test_name(integrators::Method method) {
  std::string text(integrators::name(method));
  std::erase(text, '-');
  return text;
}

}  // namespace isotach::tests
