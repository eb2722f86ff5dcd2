// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Sensitivities and tangents by CVODES: against a closed form, and against Jets through Fellin-Ostermann.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrators/sensitivities.hpp"
#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using model::ParameterId;
using tests::compression_rate;
using tests::Law;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

constexpr int kParameters = static_cast<int>(model::kParameterCount);
using Jet = ceres::Jet<double, kParameters>;
/// T/|T|, e, Omega, strain by the parameters, each derivative times the parameter's value.
using Relative = Eigen::Matrix<double, 19, kParameters>;

CvodeTolerance tight() {
  CvodeTolerance tolerance;
  tolerance.relative = 1e-11;
  tolerance.absolute_stress = 1e-7;
  return tolerance;
}

std::vector<Direction> along_every_parameter() {
  std::vector<Direction> directions;
  for (const auto& parameter : model::kParameterTable) directions.push_back(along(parameter.id));
  return directions;
}

Relative by_cvodes(const Law& law, const State& start, const Increment<double>& increment) {
  const auto end =
      integrate_with_sensitivities(law, start, increment, tight(), along_every_parameter()).value();
  Relative result;
  for (int k = 0; k < kParameters; ++k) {
    const auto& d = end.derivatives[static_cast<std::size_t>(k)];
    result.col(k) << d.state.stress / end.result.state.stress.norm(), d.state.void_ratio, d.state.omega,
        d.strain;
    result.col(k) *= law.parameters().values().values[static_cast<std::size_t>(k)];
  }
  return result;
}

Relative through_fellin_ostermann(const Law& law, const State& start, const Increment<double>& increment,
                                  double relative) {
  model::ParameterValues<Jet> values;
  for (std::size_t k = 0; k < model::kParameterCount; ++k) {
    values.values[k] = Jet(law.parameters().values().values[k], static_cast<int>(k));
  }
  const model::Law<Jet> jet_law(model::Parameters<Jet>::create(values).value());
  Tolerance tolerance;
  tolerance.relative = relative;
  const auto end =
      integrate_fellin_ostermann(jet_law, model::cast<Jet>(start), increment.cast<Jet>(), tolerance).value();
  const double size = model::plain(end.state).stress.norm();
  Relative result;
  for (int i = 0; i < 6; ++i) {
    result.row(i) = end.state.stress[i].v.transpose() / size;
    result.row(7 + i) = end.state.omega[i].v.transpose();
    result.row(13 + i) = end.strain[i].v.transpose();
  }
  result.row(6) = end.state.void_ratio.v.transpose();
  for (int k = 0; k < kParameters; ++k) {
    result.col(k) *= law.parameters().values().values[static_cast<std::size_t>(k)];
  }
  return result;
}

Law law_of(double C_1, double C_2 = 0.0, double C_3 = 0.0) {
  auto values = tests::set_a_values();
  values[ParameterId::C_1] = C_1;
  values[ParameterId::C_2] = C_2;
  values[ParameterId::C_3] = C_3;
  return Law(model::Parameters<double>::create(values).value());
}

State inclined() {
  State state{stress_kPa(100.0, 65.0, 70.0), 1.5};
  state.omega << 0.1, -0.06, -0.04, 0.02, 0.0, -0.01;
  return state;
}

Increment<double> undrained_shear_with_spin() {
  Vector6 rate = compression_rate(1e-6, -4e-7, -6e-7);
  rate[3] = 4e-7;
  auto increment = strain_increment<double>(rate, 5e4);
  increment.spin << 3e-7, 0.0, -2e-7;
  return increment;
}

struct Case {
  const char* name;
  Law law;
  State start;
  Increment<double> increment;
};

std::vector<Case> cases() {
  const State k0{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const auto crs = strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 5e4);
  Increment<double> creep;
  creep.duration = 1e6;
  creep.stress_controlled = {true, true, true, false, false, true};
  Increment<double> drained = crs;
  drained.stress_controlled = {false, true, true, false, false, false};
  return {{"CRS oedometer", law_of(0.1), k0, crs},
          {"creep under stress control", law_of(0.1), {stress_kPa(100.0, 70.0, 75.0), 1.5}, creep},
          {"undrained shear with spin", law_of(0.1), k0, undrained_shear_with_spin()},
          {"drained compression with Omega", law_of(0.05, 10.0, 0.5), inclined(), drained},
          {"undrained shear with spin and Omega", law_of(0.05, 10.0, 0.5), inclined(),
           undrained_shear_with_spin()}};
}

TEST(CvodesSensitivity, AgreesWithJetsThroughFellinOstermannToItsTolerance) {
  for (const Case& c : cases()) {
    const Relative expected = by_cvodes(c.law, c.start, c.increment);
    EXPECT_GT(expected.norm(), 0.1) << c.name;
    // sensitivities of up to 1/(lambda I_v) = 200 carry the relative error of the state so much further
    const double coarse = (through_fellin_ostermann(c.law, c.start, c.increment, 1e-5) - expected).norm();
    const double fine = (through_fellin_ostermann(c.law, c.start, c.increment, 1e-7) - expected).norm();
    EXPECT_LT(coarse, 20.0 * 1e-5 * (1.0 + expected.norm())) << c.name;
    EXPECT_LT(fine, 20.0 * 1e-7 * (1.0 + expected.norm())) << c.name;
    EXPECT_LT(fine, coarse / 30.0) << c.name;
  }
}

TEST(CvodesSensitivity, OfIsotropicCreepAreTheDerivativesOfTheClosedForm) {
  // eps = I_v lambda ln(1 + t/t0), t0 = I_v lambda/rv0, rv0 = sqrt3 D_r OCR0^(-1/I_v), OCR0 = p_B(e0)/p;
  // kappa and phi_c do not enter
  using Inputs = ceres::Jet<double, 5>;  // e100, lambda, I_v, D_r, e0
  const Inputs e100(1.5, 0);
  const Inputs lambda(0.1, 1);
  const Inputs I_v(0.05, 2);
  const Inputs D_r(1e-6, 3);
  const Inputs e0(1.48, 4);
  const double duration = 1e6;
  const Inputs log_ocr = -log((1.0 + e0) / (1.0 + e100)) / lambda - std::log(0.9);
  const Inputs rv0 = std::sqrt(3.0) * D_r * exp(-log_ocr / I_v);
  const Inputs strain = I_v * lambda * log(1.0 + duration * rv0 / (I_v * lambda));
  const Inputs e = (1.0 + e0) * exp(-strain) - 1.0;

  const Law law = law_of(0.0);
  Increment<double> hold;
  hold.duration = duration;
  hold.stress_controlled.fill(true);
  std::vector<Direction> directions{along(ParameterId::e100), along(ParameterId::lambda),
                                    along(ParameterId::I_v), along(ParameterId::D_r), Direction{}};
  directions.back().start.void_ratio = 1.0;
  directions.push_back(along(ParameterId::kappa));
  directions.push_back(along(ParameterId::phi_c));
  const auto end =
      integrate_with_sensitivities(law, {stress_kPa(90.0, 90.0, 90.0), 1.48}, hold, tight(), directions)
          .value();
  EXPECT_NEAR(end.result.state.void_ratio, e.a, 1e-9);
  for (int k = 0; k < 7; ++k) {
    SCOPED_TRACE(k);
    const Derivative& d = end.derivatives[static_cast<std::size_t>(k)];
    const double expected_strain = k < 5 ? strain.v[k] : 0.0;
    const double expected_e = k < 5 ? e.v[k] : 0.0;
    const double size = k < 5 ? std::abs(expected_strain) : 1.0;
    EXPECT_NEAR(-d.strain.head<3>().sum(), expected_strain, 1e-8 * size);
    EXPECT_NEAR(d.state.void_ratio, expected_e, 3e-8 * size);
    EXPECT_LE(d.state.stress.norm(), 1e-8 * 90e3 * size);
  }
}

TEST(CvodesSensitivity, CarriesOnThroughTheNextIncrement) {
  for (const Case& c : cases()) {
    if (!c.increment.strain_driven()) continue;
    const Relative whole = by_cvodes(c.law, c.start, c.increment);
    Increment<double> half = c.increment;
    half.duration /= 2.0;
    auto directions = along_every_parameter();
    const auto middle = integrate_with_sensitivities(c.law, c.start, half, tight(), directions).value();
    for (std::size_t k = 0; k < directions.size(); ++k) directions[k].start = middle.derivatives[k].state;
    const auto end =
        integrate_with_sensitivities(c.law, middle.result.state, half, tight(), directions).value();
    for (int k = 0; k < kParameters; ++k) {
      const auto index = static_cast<std::size_t>(k);
      const Vector6 stress = end.derivatives[index].state.stress * c.law.parameters().values().values[index] /
                             end.result.state.stress.norm();
      EXPECT_LE((stress - whole.col(k).head<6>()).norm(), 1e-8 * (1.0 + whole.norm())) << c.name << k;
    }
  }
}

TEST(CvodesSensitivity, TheStateIsThatWithoutSensitivitiesWithinTheTolerance) {
  for (const Case& c : cases()) {
    const auto plain = integrate_cvode(c.law, c.start, c.increment, tight()).value();
    const auto end =
        integrate_with_sensitivities(c.law, c.start, c.increment, tight(), along_every_parameter());
    ASSERT_TRUE(end) << end.error().message();
    EXPECT_LE((end->result.state.stress - plain.state.stress).norm(), 1e-8 * plain.state.stress.norm())
        << c.name;
    EXPECT_NEAR(end->result.state.void_ratio, plain.state.void_ratio, 1e-8) << c.name;
  }
}

TEST(CvodesSensitivity, DirectionAlongC2LeavesOmegaZeroOnlyInTheState) {
  // at C_2 = 0 and Omega = 0, dOmega/dt = 0 but d(dOmega/dt)/dC_2 = C_3 |D_vis| T*/p
  const Law law = law_of(0.0, 0.0, 0.5);
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const auto increment = strain_increment<double>(Vector6::Zero(), 1.0);
  const auto end =
      integrate_with_sensitivities(law, start, increment, tight(), {along(ParameterId::C_2)}).value();
  EXPECT_EQ(end.result.state.omega, Vector6::Zero());
  const auto at = law.measures(start);
  const Vector6 expected = 0.5 * law.viscous_rate(at.equivalent_pressure, 1.5) * at.ratio;
  // over a second the stress falls by 1e-5 of itself
  EXPECT_LE((end.derivatives[0].state.omega - expected).norm(), 1e-3 * expected.norm());
}

TEST(CvodesSensitivity, ZeroDurationReturnsTheStateAndTheDirections) {
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  Direction direction;
  direction.start.stress[1] = 2.0;
  direction.start.void_ratio = 3.0;
  const auto end =
      integrate_with_sensitivities(law_of(0.1), start, Increment<double>{}, tight(), {direction}).value();
  EXPECT_EQ(end.result.state.stress, start.stress);
  EXPECT_EQ(end.derivatives[0].state.stress, direction.start.stress);
  EXPECT_EQ(end.derivatives[0].state.void_ratio, 3.0);
  EXPECT_EQ(end.derivatives[0].strain, Vector6::Zero());
}

TEST(CvodesSensitivity, FailuresAreResults) {
  const State outside{stress_kPa(-1.0, -1.0, -1.0), 1.5};
  const auto crs = strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 1e4);
  const auto end = integrate_with_sensitivities(law_of(0.1), outside, crs, tight(), along_every_parameter());
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error().kind, FailureKind::outside_domain);
  CvodeTolerance few = tight();
  few.max_steps = 5;
  const auto limited = integrate_with_sensitivities(law_of(0.1), {stress_kPa(100.0, 65.0, 65.0), 1.5}, crs,
                                                    few, along_every_parameter());
  ASSERT_FALSE(limited);
  EXPECT_EQ(limited.error().kind, FailureKind::too_many_substeps);
}

TEST(CvodesTangent, TheTangentOfTheDiscreteMapTendsToIt) {
  for (const Case& c : cases()) {
    if (!c.increment.strain_driven()) continue;
    Increment<double> increment = c.increment;
    increment.duration = 5e3;
    const auto expected = integrate_cvode_with_tangent(c.law, c.start, increment, tight()).value();
    const auto distance = [&](double relative) {
      Tolerance tolerance;
      tolerance.relative = relative;
      const auto end = integrate_with_tangent(c.law, c.start, increment, tolerance).value();
      return (end.tangent - expected.tangent).norm() / expected.tangent.norm();
    };
    const double coarse = distance(1e-5);
    const double fine = distance(1e-7);
    EXPECT_LT(coarse, 1e-3) << c.name;
    EXPECT_LT(fine, 1e-5) << c.name;
    EXPECT_LT(fine, coarse / 30.0) << c.name;
  }
}

TEST(CvodesTangent, AStressControlledIncrementIsRefused) {
  Increment<double> creep;
  creep.duration = 1e3;
  creep.stress_controlled.fill(true);
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  EXPECT_THROW((void)integrate_cvode_with_tangent(law_of(0.1), start, creep, tight()), std::invalid_argument);
}

TEST(CvodeRows, LieOnTheSolutionAndTakeNoStepMore) {
  for (const Case& c : cases()) {
    const int rows = 50;
    const auto curve = integrate_cvode_rows(c.law, c.start, c.increment, rows, tight()).value();
    ASSERT_EQ(curve.size(), 50U);
    const auto end = integrate_cvode(c.law, c.start, c.increment, tight()).value();
    EXPECT_EQ(curve.back().state.stress, end.state.stress) << c.name;
    EXPECT_EQ(curve.back().strain, end.strain) << c.name;
    EXPECT_EQ(curve.back().statistics.accepted, end.statistics.accepted) << c.name;
    for (const int row : {1, 7, 25}) {
      Increment<double> part = c.increment;
      part.duration *= static_cast<double>(row) / rows;
      const auto expected = integrate_cvode(c.law, c.start, part, tight()).value();
      const auto& got = curve[static_cast<std::size_t>(row - 1)];
      EXPECT_LE((got.state.stress - expected.state.stress).norm(), 1e-8 * expected.state.stress.norm())
          << c.name;
      EXPECT_LE((got.state.omega - expected.state.omega).norm(), 1e-8) << c.name;
      EXPECT_NEAR(got.state.void_ratio, expected.state.void_ratio, 1e-8) << c.name;
      EXPECT_LE((got.strain - expected.strain).norm(), 1e-8) << c.name;
    }
  }
}

TEST(CvodeRows, AreAllTheStartWhereNoTimePassesAndAtLeastOne) {
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const auto rows = integrate_cvode_rows(law_of(0.1), start, Increment<double>{}, 3, tight()).value();
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& row : rows) EXPECT_EQ(row.state.stress, start.stress);
  EXPECT_THROW((void)integrate_cvode_rows(law_of(0.1), start, Increment<double>{}, 0, tight()),
               std::invalid_argument);
}

}  // namespace
}  // namespace isotach::integrators
