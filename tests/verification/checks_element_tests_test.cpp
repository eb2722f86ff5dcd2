// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Whole element tests against closed forms, and against the same motion described another way.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "integrators/element_test.hpp"
#include "tests/set_a.hpp"

namespace isotach::tests {
namespace {

using integrators::ElementRow;
using integrators::Increment;
using integrators::kMethods;
using integrators::Method;
using integrators::Stage;

const double kM =
    6.0 * std::sin(25.0 * std::numbers::pi / 180.0) / (3.0 - std::sin(25.0 * std::numbers::pi / 180.0));
const State kIsotropic{stress_kPa(100.0, 100.0, 100.0), 1.5};

std::vector<ElementRow> rows_of(const Law& law, const State& start, const std::vector<Stage>& stages,
                                Method method, double relative) {
  integrators::Options options;
  options.method = method;
  options.fellin_ostermann.relative = relative;
  options.rosenbrock.relative = relative;
  auto rows = integrators::run_element_test(law, start, stages, options);
  if (!rows) throw std::runtime_error(rows.error().failure.message());
  return *std::move(rows);
}

/// Axial compression at 1e-6 /s to the axial strain given, the lateral stresses under control.
Stage axial(double strain, int rows) {
  Stage stage{"shear", {}, rows};
  stage.increment.duration = strain / 1e-6;
  stage.increment.strain_rate[0] = -1e-6;
  stage.increment.stress_controlled[1] = stage.increment.stress_controlled[2] = true;
  return stage;
}

/// The lateral stresses keep equal rates that leave the mean stress where it is.
Stage at_constant_p(double strain, int rows) {
  Stage stage = axial(strain, rows);
  stage.increment.condition.row(1) << 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0, 0.0, 0.0;
  stage.increment.condition.row(2) << 0.0, 1.0, -1.0, 0.0, 0.0, 0.0;
  return stage;
}

/// Void ratio of steady flow at the critical state under p (kPa): m is deviatoric, so that |D_vis| + C_1 |D|
/// = |D| and OCR = [(1 - C_1) |D|/D_r]^-I_v, while p_B+ = 2 p there; p_B from e100 = 1.5, lambda = 0.1.
double critical_void_ratio(double p, double C_1) {
  const double norm = std::sqrt(1.5) * 1e-6;
  const double p_B = 2.0 * p * std::pow((1.0 - C_1) * norm / 1e-6, -0.05);
  return 2.5 * std::pow(p_B / 100.0, -0.1) - 1.0;
}

TEST(ElementTests, DrainedTriaxialRunsAtThreeToOneToTheRateCorrectedCriticalState) {
  const Law law(set_a(0.1));
  for (const Method method : kMethods) {
    SCOPED_TRACE(integrators::name(method));
    const auto rows = rows_of(law, kIsotropic, {axial(3.0, 100)}, method, 1e-8);
    for (const ElementRow& row : rows) {
      EXPECT_NEAR(q_kPa(row.state), 3.0 * (p_kPa(row.state) - 100.0), 1e-9 * 100.0);
    }
    // q = M p on q = 3 (p - p0); what is left to go falls by about e^-6.4 a unit of strain, to 4e-9 of q/p
    const double p = 300.0 / (3.0 - kM);
    EXPECT_NEAR(p_kPa(rows.back().state), p, 1e-6 * p);
    EXPECT_NEAR(q_kPa(rows.back().state), kM * p, 1e-6 * p);
    EXPECT_NEAR(rows.back().state.void_ratio, critical_void_ratio(p, 0.1), 1e-6);
  }
}

TEST(ElementTests, ConstantPKeepsPAndEndsAtTheCriticalState) {
  const Law law(set_a(0.1));
  Stage back = at_constant_p(0.5, 20);  // and a reversal of the axial strain
  back.increment.strain_rate[0] = 1e-6;
  for (const Method method : kMethods) {
    SCOPED_TRACE(integrators::name(method));
    const auto rows = rows_of(law, kIsotropic, {at_constant_p(3.0, 60), back}, method, 1e-8);
    for (const ElementRow& row : rows) {
      EXPECT_NEAR(p_kPa(row.state), 100.0, 1e-9 * 100.0);
      EXPECT_NEAR(row.state.stress[1], row.state.stress[2], 1e-9 * 100e3);
    }
    EXPECT_NEAR(q_kPa(rows[60].state), kM * 100.0, 1e-4);
    EXPECT_NEAR(rows[60].state.void_ratio, critical_void_ratio(100.0, 0.1), 1e-6);
    EXPECT_LT(q_kPa(rows.back().state), 0.0);
  }
}

TEST(ElementTests, AMeanStressTargetIsReachedAlongTheAxialStrain) {
  Stage to_p = at_constant_p(0.02, 10);
  to_p.target[1] = -150e3;
  const auto rows = rows_of(Law(set_a()), kIsotropic, {to_p}, Method::fellin_ostermann, 1e-6);
  EXPECT_NEAR(p_kPa(rows.back().state), 150.0, 1e-9 * 150.0);
  EXPECT_NEAR(p_kPa(rows[5].state), 125.0, 1e-9 * 150.0);
  EXPECT_NEAR(rows.back().strain[0], -0.02, 1e-13);
}

TEST(ElementTests, UndrainedKeepsTheVoidRatioThroughCycles) {
  const Law law(set_a(0.1));
  std::vector<Stage> cycles;
  for (int i = 0; i < 20; ++i) {
    Stage stage{"cycle", {}, 5};
    stage.increment.duration = 2e3;
    const double axial_strain = i % 2 == 0 ? -2e-3 : 2e-3;
    stage.target = {axial_strain, -0.5 * axial_strain, -0.5 * axial_strain};
    cycles.push_back(stage);
  }
  for (const Method method : kMethods) {
    const auto rows = rows_of(law, kIsotropic, cycles, method, 1e-6);
    // the trace of the strain rate is a rest of round-off: the void ratio hardly moves
    for (const ElementRow& row : rows)
      EXPECT_NEAR(row.state.void_ratio, 1.5, 1e-13) << integrators::name(method);
    EXPECT_LT(p_kPa(rows.back().state), 90.0);  // and the cycles take pressure from the skeleton
  }
}

TEST(ElementTests, LoadStepsEndOnTheIsotachOfTheirCreepTime) {
  // isotropic steps of a day, each doubling p: creep at constant p has the rate r0 OCR^(-1/I_v), which
  // integrates to OCR = OCR0 (1 + t/t0)^I_v with t0 = I_v lambda/(r0 OCR0^(-1/I_v)); once t >> t0 no trace of
  // OCR0 is left, OCR = (r0 t/(I_v lambda))^I_v
  const Law law(set_a());
  constexpr double kDay = 86400.0;
  constexpr double kRamp = 10.0;
  std::vector<Stage> steps;
  for (const double p : {200.0, 400.0, 800.0}) {
    Stage load{"load", {}, 1};
    load.increment.duration = kRamp;
    load.increment.stress_controlled = {true, true, true};
    load.target = {-1e3 * p, -1e3 * p, -1e3 * p};
    Stage hold{"hold", {}, 30};
    hold.increment.duration = kDay;
    hold.increment.stress_controlled = {true, true, true};
    hold.first_row = 10.0;
    steps.push_back(load);
    steps.push_back(hold);
  }
  const double isotach = std::pow(std::sqrt(3.0) * 1e-6 * kDay / (0.05 * 0.1), 0.05);
  for (const Method method : kMethods) {
    SCOPED_TRACE(integrators::name(method));
    const auto rows = rows_of(law, kIsotropic, steps, method, 1e-8);
    for (std::size_t step = 0; step < 3; ++step) {
      const ElementRow& loaded = rows[1 + 31 * step];
      const ElementRow& crept = rows[31 * (step + 1)];
      EXPECT_NEAR(p_kPa(crept.state), 200.0 * std::pow(2.0, static_cast<double>(step)), 1e-6);
      const double t0 = 0.05 * 0.1 / (std::sqrt(3.0) * 1e-6) * std::pow(loaded.overconsolidation_ratio, 20.0);
      const double exact = loaded.overconsolidation_ratio * std::pow(1.0 + kDay / t0, 0.05);
      EXPECT_NEAR(crept.overconsolidation_ratio, exact, 2e-7 * exact);
      // of OCR0 there is left 1/20 of t0/t, where t0 is no longer than the ramp
      EXPECT_LE(t0, kRamp);
      EXPECT_NEAR(crept.overconsolidation_ratio, isotach, 0.05 * kRamp / kDay * isotach);
    }
  }
}

TEST(ElementTests, OedometricCreepTendsToLambdaIvAnEFoldOfTime) {
  // d eps/d ln t -> lambda I_v once K0 no longer moves: the slope of equidistant isotachs, whatever the
  // stress path
  const Law law(set_a());
  Stage hold{"hold", {}, 60};
  hold.increment.duration = 1e12;
  hold.increment.stress_controlled[0] = true;
  hold.first_row = 1e6;
  const auto rows = rows_of(law, {stress_kPa(100.0, 70.0, 70.0), 1.5}, {hold}, Method::rosenbrock, 1e-8);
  const ElementRow& last = rows.back();
  const ElementRow& before = rows[rows.size() - 2];
  const double slope = (before.strain[0] - last.strain[0]) / std::log(last.time / before.time);
  EXPECT_NEAR(slope, 0.1 * 0.05, 0.02 * 0.1 * 0.05);
}

/// Simple shear dv1/dx2 = 2 `rate` described in axes that turn with the material, where there is no spin and
/// the strain rate turns the other way: n steps, each at the strain rate of its middle, turned back at the
/// end.
Eigen::Matrix3d sheared_in_turning_axes(const Law& law, const State& start, double rate, double duration,
                                        int n) {
  const auto turn = [rate](double time) {
    Eigen::Matrix3d Q = Eigen::Matrix3d::Identity();  // dQ/dt = W Q, W12 = rate
    const double c = std::cos(rate * time);
    const double s = std::sin(rate * time);
    Q.topLeftCorner<2, 2>() << c, s, -s, c;
    return Q;
  };
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();
  D(0, 1) = D(1, 0) = rate;
  State state = start;
  for (int i = 0; i < n; ++i) {
    const Eigen::Matrix3d Q = turn(duration * (i + 0.5) / n);
    const Eigen::Matrix3d in_turning_axes = Q.transpose() * D * Q;
    state = strained(law, state, model::mandel_from_matrix<double>(in_turning_axes), duration / n,
                     tight(Method::cvode));
  }
  return turn(duration) * model::matrix_from_mandel<double, 6>(state.stress) * turn(duration).transpose();
}

TEST(ElementTests, SimpleShearIsTheSameMotionInTurningAxes) {
  const Law law(set_a(0.1));
  const State start{stress_kPa(65.0, 100.0, 65.0), 1.5};
  constexpr double kRate = 5e-7;
  Stage shear{"shear", {}, 10};
  shear.increment.duration = 5e5;  // gamma = 0.5
  shear.increment.strain_rate[3] = std::numbers::sqrt2 * kRate;
  shear.increment.spin[0] = kRate;
  const Eigen::Matrix3d coarse = sheared_in_turning_axes(law, start, kRate, 5e5, 100);
  const Eigen::Matrix3d fine = sheared_in_turning_axes(law, start, kRate, 5e5, 200);
  const Eigen::Matrix3d limit = fine + (fine - coarse) / 3.0;  // the middle's rule is of order 2
  for (const Method method : kMethods) {
    const auto rows = rows_of(law, start, {shear}, method, 1e-8);
    const Eigen::Matrix3d stress = model::matrix_from_mandel<double, 6>(rows.back().state.stress);
    EXPECT_LE((stress - limit).norm(), 1e-6 * limit.norm()) << integrators::name(method);
    EXPECT_GE((stress - coarse).norm(), 10.0 * (stress - limit).norm());
    EXPECT_GT(stress(0, 1), 0.0);
  }
  // without the spin the answer is another
  shear.increment.spin[0] = 0.0;
  const auto without = rows_of(law, start, {shear}, Method::cvode, 1e-8);
  EXPECT_GT((model::matrix_from_mandel<double, 6>(without.back().state.stress) - limit).norm(),
            1e-2 * limit.norm());
}

}  // namespace
}  // namespace isotach::tests
