// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Sensitivities carried through Fellin-Ostermann by Jets, against finite differences of CVODE.
#include <gtest/gtest.h>

#include <vector>

#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::set_a;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

// Parameters, each by the logarithm of its value.
constexpr int kInputs = static_cast<int>(model::kParameterCount);
using Jet = ceres::Jet<double, kInputs>;
using Outputs = Eigen::Matrix<double, 7, 1>;  // T/100 kPa, e

model::ParameterValues<double> base_values() {
  return set_a(0.1).values();
}

Outputs outputs(const State& state) {
  Outputs result;
  result << state.stress / 100e3, state.void_ratio;
  return result;
}

Increment<Jet> with_jets(const Increment<double>& increment) {
  Increment<Jet> result;
  result.duration = increment.duration;
  result.strain_rate = increment.strain_rate.cast<Jet>();
  result.stress_rate = increment.stress_rate.cast<Jet>();
  result.stress_controlled = increment.stress_controlled;
  result.spin = increment.spin.cast<Jet>();
  return result;
}

/// Richardson's extrapolation of central differences of `f` at 0.
template <class F>
Outputs difference(double h, F&& f) {
  const Outputs coarse = (f(h) - f(-h)) / (2.0 * h);
  const Outputs fine = (f(h / 2) - f(-h / 2)) / h;
  return (4.0 * fine - coarse) / 3.0;
}

Outputs through_cvode(const model::ParameterValues<double>& values, const State& start,
                      const std::vector<Increment<double>>& increments) {
  const Law law(model::Parameters<double>::create(values).value());
  State state = start;
  for (const auto& increment : increments) {
    state = integrate(law, state, increment, tests::tight(Method::cvode)).value().state;
  }
  return outputs(state);
}

void expect_parameter_sensitivities(const State& start, const std::vector<Increment<double>>& increments) {
  model::ParameterValues<Jet> values;
  for (int i = 0; i < kInputs; ++i) {
    const auto index = static_cast<std::size_t>(i);
    values.values[index] = Jet(base_values().values[index], i);
  }
  const model::Law<Jet> law(model::Parameters<Jet>::create(values).value());
  Tolerance tolerance;
  tolerance.relative = 1e-9;
  model::State<Jet> state{start.stress.cast<Jet>(), Jet(start.void_ratio)};
  for (const auto& increment : increments) {
    state = integrate_fellin_ostermann(law, state, with_jets(increment), tolerance).value().state;
  }
  for (int j = 0; j < kInputs; ++j) {
    const auto index = static_cast<std::size_t>(j);
    SCOPED_TRACE(model::kParameterTable[index].name);
    const Outputs expected = difference(2e-3, [&](double h) {
      auto moved = base_values();
      moved.values[index] *= std::exp(h);
      return through_cvode(moved, start, increments);
    });
    // CVODE's error of 1e-11 over h makes 1e-8; truncation is (20 h)^4 ~ 2e-6 of the largest term, 1/(lambda
    // I_v) of a power, and an order less for all but lambda and I_v
    const double tolerance_of_difference = 2e-6 * std::max(1.0, expected.norm());
    for (int i = 0; i < 7; ++i) {
      const Jet& output = i < 6 ? state.stress[i] : state.void_ratio;
      const double unit = i < 6 ? 100e3 : 1.0;
      EXPECT_NEAR(output.v[j] * base_values().values[index] / unit, expected[i], tolerance_of_difference)
          << "output " << i;
    }
  }
}

TEST(Sensitivity, ToEveryParameterAlongOedometerLoadUnloadRelax) {
  const Vector6 load = compression_rate(1e-6, 0.0, 0.0);
  expect_parameter_sensitivities({stress_kPa(100.0, 65.0, 65.0), 1.5},
                                 {strain_increment<double>(load, 5e4), strain_increment<double>(-load, 5e3),
                                  strain_increment<double>(Vector6::Zero(), 1e5)});
}

TEST(Sensitivity, ToEveryParameterUnderMixedControlFromIsotropicStress) {
  Increment<double> creep;
  creep.duration = 1e5;
  creep.stress_controlled.fill(true);
  Increment<double> drained;
  drained.duration = 3e4;
  drained.strain_rate[0] = -1e-6;
  drained.stress_controlled = {false, true, true, true, true, true};
  expect_parameter_sensitivities({stress_kPa(100.0, 100.0, 100.0), 1.45}, {creep, drained});
}

TEST(Sensitivity, TangentToStrainIncrementIsThatOfTheExactSolution) {
  // increments of strain at fixed duration: d T_new/d(D dt) = (dT/dD)/dt
  using Jet6 = ceres::Jet<double, 6>;
  const model::Parameters<double> parameters = set_a(0.1);
  const model::Law<Jet6> law(parameters.cast<Jet6>());
  Vector6 stress = stress_kPa(100.0, 70.0, 80.0);
  stress[3] = 8e3;
  Vector6 strain_rate = compression_rate(1e-6, -2e-7, 1e-7);
  strain_rate[4] = 5e-7;
  const double duration = 2e3;
  Increment<Jet6> increment;
  increment.duration = duration;
  for (int i = 0; i < 6; ++i) increment.strain_rate[i] = Jet6(strain_rate[i], i);
  Tolerance tolerance;
  tolerance.relative = 1e-9;
  const model::State<Jet6> start{stress.cast<Jet6>(), Jet6(1.5)};
  const auto end = integrate_fellin_ostermann(law, start, increment, tolerance).value();
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(end.strain[j].v[j] / duration, 1.0, 1e-12);
    const Outputs expected = difference(2e-3, [&](double h) {
      Vector6 moved = strain_rate;
      moved[j] += 1e-6 * h;
      return outputs(
          tests::strained(Law(parameters), {stress, 1.5}, moved, duration, tests::tight(Method::cvode)));
    });
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(end.state.stress[i].v[j] * 1e-6 / 100e3, expected[i], 1e-7) << i << j;
    }
  }
}

TEST(Sensitivity, ZeroDurationKeepsDerivativesOfTheState) {
  const model::Law<Jet> law(set_a().cast<Jet>());
  model::State<Jet> start;
  for (int i = 0; i < 6; ++i) start.stress[i] = Jet(i < 3 ? -1e5 : 0.0, i);
  start.void_ratio = Jet(1.5, 6);
  const auto end = integrate_fellin_ostermann(law, start, Increment<Jet>{}, Tolerance{}).value();
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(end.state.stress[i].a, start.stress[i].a);
    EXPECT_EQ(end.state.stress[i].v, start.stress[i].v);
  }
  EXPECT_EQ(end.state.void_ratio.v, start.void_ratio.v);
}

}  // namespace
}  // namespace isotach::integrators
