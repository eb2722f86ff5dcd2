// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Adaptive extrapolated Euler: its order, how its error follows the tolerance, and its substep control.
#include <gtest/gtest.h>

#include <vector>

#include "integrators/fellin_ostermann.hpp"
#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::p_kPa;
using tests::set_a;
using tests::State;
using tests::strained;
using tests::stress_kPa;
using tests::Vector6;

constexpr double kRate = 1e-6;  // 1/s

/// A tolerance that no substep misses: every substep is as long as asked for.
Tolerance no_control() {
  Tolerance tolerance;
  tolerance.relative = 1e30;
  return tolerance;
}

State in_equal_substeps(const Law& law, const State& start, const Vector6& strain_rate, double duration,
                        int n) {
  State state = start;
  for (int i = 0; i < n; ++i) {
    const auto end = integrate_fellin_ostermann(
                         law, state, strain_increment<double>(strain_rate, duration / n), no_control())
                         .value();
    EXPECT_EQ(end.statistics.accepted, 1);
    EXPECT_EQ(end.statistics.rejected, 0);
    state = end.state;
  }
  return state;
}

/// Orders of convergence seen from one halving of the substep to the next.
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> result;
  for (std::size_t i = 1; i < errors.size(); ++i) result.push_back(std::log2(errors[i - 1] / errors[i]));
  return result;
}

TEST(ExtrapolatedEuler, IsOfSecondOrderAgainstTheClosedFormOfIsotropicCompression) {
  // z = (p/p_B)^(-1/I_v) = z_inf + (1 - z_inf) exp(-A t/I_v), A = r(1/kappa - 1/lambda), z_inf = sqrt3
  // D_r/(kappa A)
  const Law law(set_a());
  const double duration = 0.004 / kRate;
  const double z_inf = std::numbers::sqrt3 * 1e-6 / (0.02 * kRate * 40.0);
  const double expected = std::pow(z_inf + (1.0 - z_inf) * std::exp(-800.0 * 0.004), -0.05);
  std::vector<double> errors;
  for (const int n : {100, 200, 400, 800, 1600}) {
    const State end = in_equal_substeps(law, {stress_kPa(100.0, 100.0, 100.0), 1.5},
                                        compression_rate(kRate / 3, kRate / 3, kRate / 3), duration, n);
    errors.push_back(std::abs(p_kPa(end) * 1e3 / law.preconsolidation_pressure(end.void_ratio) - expected));
  }
  // the next term of the error is h lambda of its first: 800 * 4e-5 = 0.03 at the coarsest level
  for (const double order : orders(errors)) EXPECT_NEAR(order, 2.0, 0.05);
}

TEST(ExtrapolatedEuler, IsOfSecondOrderAlongAGeneralPath) {
  const Law law(set_a(0.1));
  const State start{stress_kPa(100.0, 70.0, 80.0), 1.5};
  Vector6 strain_rate = compression_rate(kRate, -0.4 * kRate, 0.1 * kRate);
  strain_rate[3] = 0.7 * kRate;
  strain_rate[5] = -0.2 * kRate;
  const double duration = 0.02 / kRate;
  const State expected = strained(law, start, strain_rate, duration, tests::tight(Method::cvode));
  std::vector<double> errors;
  for (const int n : {500, 1000, 2000, 4000}) {
    const State end = in_equal_substeps(law, start, strain_rate, duration, n);
    errors.push_back((end.stress - expected.stress).norm());
  }
  // the fastest mode decays by exp(-1000 strain): h lambda = 0.04 at the coarsest level
  for (const double order : orders(errors)) EXPECT_NEAR(order, 2.0, 0.05);
}

TEST(FellinOstermann, ErrorIsAboutProportionalToTheTolerance) {
  // EST ~ tau^2 is held at the tolerance, and the accepted value's global error is ~ tau^2 too
  const Law law(set_a(0.1));
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const Vector6 strain_rate = compression_rate(kRate, -0.2 * kRate, -0.2 * kRate);
  const double duration = 0.1 / kRate;
  const State expected = strained(law, start, strain_rate, duration, tests::tight(Method::cvode));
  std::vector<double> errors;
  const std::vector<double> tolerances{1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
  for (const double relative : tolerances) {
    Options options;
    options.fellin_ostermann.relative = relative;
    const State end = strained(law, start, strain_rate, duration, options);
    errors.push_back((end.stress - expected.stress).norm() / expected.stress.norm());
    EXPECT_LE(errors.back(), 10.0 * relative);
    if (errors.size() > 1) {
      EXPECT_LT(errors.back(), errors[errors.size() - 2]);
    }
  }
  const double slope = std::log10(errors.front() / errors.back()) / 5.0;
  EXPECT_NEAR(slope, 1.0, 0.15);
}

TEST(FellinOstermann, ElasticPathsMissTheToleranceByTwoThirdsOfItsShareForEachUnitOfLogStress) {
  // Isotropic compression at OCR 50 and C_1 = 0: p follows exp(eps/kappa). The midpoint rule leaves (k
  // tau)^3/6 a substep and EST is (k tau)^2/4 of |T|, so that with EST held at s TOL the error of ln p is
  // (2/3) s TOL ln(p/p_0).
  const Law law(set_a());
  const State start{stress_kPa(1.0, 1.0, 1.0), law.void_ratio_at(50e3)};
  const double strain = 0.02;  // ln(p/p_0) = 1
  const auto compression = compression_rate(kRate / 3, kRate / 3, kRate / 3);
  for (const double share : {1.0, 0.25}) {
    Options options;
    options.fellin_ostermann.relative = 1e-4;
    options.fellin_ostermann.estimate_share = share;
    const State end = strained(law, start, compression, strain / kRate, options);
    const double error = 1.0 - std::log(p_kPa(end) / p_kPa(start));
    // substeps are planned for 0.81 of the tolerance, the last one is what is left, and creep is not quite
    // nil
    EXPECT_NEAR(error / (share * 1e-4), 2.0 / 3.0 * 0.81, 0.15) << share;
  }
}

TEST(FellinOstermann, HoldsThatBeginInOverstressStartWithSubstepsFarBelowTheirDuration) {
  // OCR 0.8 and I_v 0.01: |D_vis| begins at 0.8^-100 D_r = 5e9 D_r, and 1e8 s are 1e16 of its first substeps
  auto values = tests::set_a_values();
  values[model::ParameterId::I_v] = 0.01;
  values[model::ParameterId::D_r] = 1e-4;
  const Law law(model::Parameters<double>::create(values).value());
  const State start{stress_kPa(125.0, 125.0, 125.0), 1.5};
  const auto hold = strain_increment<double>(Vector6::Zero(), 1e8);
  const auto end = integrate_fellin_ostermann(law, start, hold, {});
  ASSERT_TRUE(end) << end.error().message();
  // closed form: p = p0 (1 + rv0 t/(I_v kappa))^(-I_v)
  const double rv0 = std::sqrt(3.0) * 1e-4 * std::pow(0.8, -100.0);
  EXPECT_NEAR(p_kPa(end->state) / (125.0 * std::pow(1.0 + rv0 * 1e8 / (0.01 * 0.02), -0.01)), 1.0, 1e-5);
}

TEST(FellinOstermann, SubstepsGrowAsTheToleranceToTheMinusHalf) {
  const Law law(set_a());
  const auto increment = strain_increment<double>(compression_rate(kRate, 0.0, 0.0), 1e5);
  const auto accepted = [&](double relative) {
    Tolerance tolerance;
    tolerance.relative = relative;
    const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
    return static_cast<double>(
        integrate_fellin_ostermann(law, start, increment, tolerance)->statistics.accepted);
  };
  EXPECT_NEAR(accepted(1e-9) / accepted(1e-7), 10.0, 0.5);
}

TEST(FellinOstermann, ZeroDurationReturnsTheStateUnchanged) {
  const Law law(set_a());
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  for (const Method method : {Method::fellin_ostermann, Method::cvode}) {
    Options options;
    options.method = method;
    const auto end =
        integrate(law, start, strain_increment<double>(compression_rate(kRate, 0.0, 0.0), 0.0), options);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->state.stress, start.stress);
    EXPECT_EQ(end->state.void_ratio, start.void_ratio);
    EXPECT_EQ(end->strain, Vector6::Zero());
    EXPECT_EQ(end->statistics.evaluations, 0);
  }
}

TEST(FellinOstermann, ReturnedSubstepContinuesWithoutRejection) {
  const Law law(set_a());
  const auto increment = strain_increment<double>(compression_rate(kRate, 0.0, 0.0), 2e4);
  const auto first =
      integrate_fellin_ostermann(law, State{stress_kPa(100.0, 65.0, 65.0), 1.5}, increment, {}).value();
  EXPECT_GT(first.statistics.rejected, 0);  // the whole increment was tried at first
  const auto second = integrate_fellin_ostermann(law, first.state, increment, {}, first.next_substep).value();
  EXPECT_EQ(second.statistics.rejected, 0);
}

TEST(FellinOstermann, StrainIsTheTimeIntegralOfStrainRate) {
  const Law law(set_a());
  const Vector6 strain_rate = compression_rate(kRate, -0.3 * kRate, 0.1 * kRate);
  for (const Method method : {Method::fellin_ostermann, Method::cvode}) {
    const auto end = integrate(law, {stress_kPa(100.0, 65.0, 65.0), 1.5},
                               strain_increment<double>(strain_rate, 1e4), tests::tight(method))
                         .value();
    EXPECT_LE((end.strain - 1e4 * strain_rate).norm(), 1e-13);
    // de/dt = (1+e) tr D
    EXPECT_NEAR(1.0 + end.state.void_ratio, 2.5 * std::exp(1e4 * strain_rate.head<3>().sum()), 2e-10);
  }
}

TEST(FellinOstermannError, IsTheLargerOfStressAndVoidRatioInUnitsOfTheTolerance) {
  Tolerance tolerance;
  tolerance.relative = 1e-3;
  tolerance.absolute_stress = 5.0;
  const State w{stress_kPa(3.0, 0.0, 4.0), 1.5};  // |T| = 5 kPa: 10 Pa are one unit
  EXPECT_EQ((scaled_error<double, 6>(w, w, tolerance)), 0.0);
  State v = w;
  v.stress[1] += 20.0;
  EXPECT_NEAR((scaled_error<double, 6>(w, v, tolerance)), 2.0, 1e-12);
  v.void_ratio += 2.5e-3 * 7.0;  // 1 + e = 2.5
  EXPECT_NEAR((scaled_error<double, 6>(w, v, tolerance)), 7.0, 1e-9);
  v.stress[1] = w.stress[1];
  EXPECT_NEAR((scaled_error<double, 6>(w, v, tolerance)), 7.0, 1e-9);
  v.stress[2] = std::nan("");
  EXPECT_TRUE(std::isinf(scaled_error<double, 6>(w, v, tolerance)));
  v = w;
  v.void_ratio = std::nan("");
  EXPECT_TRUE(std::isinf(scaled_error<double, 6>(w, v, tolerance)));
}

/// de/dt = `slope`, T constant; not computable below e = `limit`.
struct Ramp {
  double slope;
  double limit;
  bool operator()(const State& y) const { return y.void_ratio >= limit; }
  bool operator()(const State& y, model::StateRate<double>& rate) const {
    if (!(*this)(y)) return false;
    rate = {Vector6::Zero(), slope};
    return true;
  }
};

TEST(FellinOstermannSubsteps, StopAtTheBorderOfTheDomainAndLeaveTheStateUnchanged) {
  const State start{stress_kPa(100.0, 100.0, 100.0), 1.0};
  State state = start;
  double substep = 0.3;
  double midpoints = 0.0;
  const auto end = fellin_ostermann_substeps(state, 2.0, Tolerance{}, substep, Ramp{-1.0, 0.5},
                                             Ramp{-1.0, 0.5}, [&](double tau) { midpoints += tau; });
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error().kind, FailureKind::substep_underflow);
  EXPECT_NEAR(end.error().time, 0.5, 1e-13);  // where e = 0.5
  EXPECT_NEAR(end.error().last_state.void_ratio, 0.5, 1e-13);
  EXPECT_GE(end.error().last_state.void_ratio, 0.5);
  // rejected substeps are not part of the integral
  EXPECT_NEAR(midpoints, end.error().time, 1e-13);
  EXPECT_EQ(state.void_ratio, start.void_ratio);
  EXPECT_EQ(state.stress, start.stress);
  EXPECT_EQ(substep, 0.3);
}

TEST(FellinOstermannSubsteps, GrowAtMostFivefoldAndEndExactlyAtTheDuration) {
  State state{stress_kPa(100.0, 100.0, 100.0), 1.0};
  double substep = 0.001;
  std::vector<double> taken;
  const auto end = fellin_ostermann_substeps(state, 1.0, Tolerance{}, substep, Ramp{0.25, 0.0},
                                             Ramp{0.25, 0.0}, [&](double tau) { taken.push_back(tau); });
  ASSERT_TRUE(end);
  // constant rate: the error is nil, so each substep is five times the last; 0.001 (5^4 - 1)/4 = 0.156, then
  // the rest
  ASSERT_EQ(taken.size(), 6U);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(taken[i] / taken[i - 1], 5.0, 1e-12);
  EXPECT_NEAR(taken[5], 1.0 - 0.781, 1e-12);
  EXPECT_NEAR(state.void_ratio, 1.25, 1e-14);
  EXPECT_NEAR(substep, 3.125, 1e-12);  // what was proposed, not what was left
  EXPECT_EQ(end->accepted, 6);
  EXPECT_EQ(end->rejected, 0);
}

}  // namespace
}  // namespace isotach::integrators
