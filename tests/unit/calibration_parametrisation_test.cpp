// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Coordinates of a fit and the parameters they stand for.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/parametrisation.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;
using tests::seed_mud;

constexpr GaugeChoice kNoGauge{datasets::Gauge::none, 0.0};
constexpr GaugeChoice kCrsGauge{datasets::Gauge::crs_rate, 7e-7};

TEST(Parametrisation, CoordinatesAreLogarithmsButThatOfC1) {
  const Parametrisation p(seed_mud(), {lambda, C_1, I_v}, {}, kNoGauge);
  ASSERT_EQ(p.free(), (std::vector{lambda, C_1, I_v}));
  EXPECT_DOUBLE_EQ(p.start()[0], std::log(0.154));
  EXPECT_DOUBLE_EQ(p.start()[1], 0.03);
  EXPECT_DOUBLE_EQ(p.start()[2], std::log(0.02));
  EXPECT_TRUE(p.coordinates()[0].logarithmic);
  EXPECT_FALSE(p.coordinates()[1].logarithmic);
}

TEST(Parametrisation, AtGivesTheParametersAndLeavesTheOthers) {
  const Parametrisation p(seed_mud(), {lambda, C_1}, {}, kNoGauge);
  const auto parameters = p.at(std::vector<double>{std::log(0.2), 0.07});
  ASSERT_TRUE(parameters.has_value());
  EXPECT_DOUBLE_EQ(parameters->lambda(), 0.2);
  EXPECT_DOUBLE_EQ(parameters->C_1(), 0.07);
  for (const model::ParameterId id : {e100, kappa, I_v, D_r, phi_c})
    EXPECT_EQ((*parameters)[id], seed_mud()[id]);
}

TEST(Parametrisation, BoundsComeFromTheStudyOrTheDefaults) {
  CoordinateSettings settings;
  settings.bounds[static_cast<std::size_t>(lambda)] = datasets::Bounds{0.1, 0.2};
  const Parametrisation p(seed_mud(), {lambda, I_v, C_1}, settings, kNoGauge);
  EXPECT_DOUBLE_EQ(p.lower()[0], std::log(0.1));
  EXPECT_DOUBLE_EQ(p.upper()[0], std::log(0.2));
  EXPECT_DOUBLE_EQ(p.lower()[1], std::log(default_bounds(I_v).lower));
  EXPECT_DOUBLE_EQ(p.upper()[1], std::log(default_bounds(I_v).upper));
  EXPECT_DOUBLE_EQ(p.lower()[2], default_bounds(C_1).lower);
}

TEST(Parametrisation, StartOutsideOfItsBoundsIsMovedToTheNearest) {
  CoordinateSettings settings;
  settings.bounds[static_cast<std::size_t>(lambda)] = datasets::Bounds{0.2, 0.3};
  settings.bounds[static_cast<std::size_t>(I_v)] = datasets::Bounds{0.005, 0.01};
  const Parametrisation p(seed_mud(), {lambda, I_v}, settings, kNoGauge);
  EXPECT_DOUBLE_EQ(p.start()[0], std::log(0.2));
  EXPECT_DOUBLE_EQ(p.start()[1], std::log(0.01));
}

TEST(Parametrisation, ParametersNotAdmissibleTogetherAreNamed) {
  const Parametrisation p(seed_mud(), {lambda, kappa}, {}, kNoGauge);
  const auto parameters = p.at(std::vector<double>{std::log(0.1), std::log(0.2)});
  ASSERT_FALSE(parameters.has_value());
  EXPECT_NE(parameters.error().find("kappa"), std::string::npos) << parameters.error();
}

TEST(Gauge, NoneLeavesDrFree) {
  const Parametrisation p(seed_mud(), {e100, D_r}, {}, kNoGauge);
  EXPECT_EQ(p.free(), (std::vector{e100, D_r}));
  EXPECT_FALSE(p.gauged());
}

TEST(Gauge, FixedKeepsDrWhereItStarts) {
  const Parametrisation p(seed_mud(), {e100, D_r}, {}, {datasets::Gauge::fixed, 0.0});
  EXPECT_EQ(p.free(), std::vector{e100});
  EXPECT_FALSE(p.gauged());
  EXPECT_EQ(p.at(std::vector<double>{0.1})->D_r(), 6.8e-7);
}

TEST(Gauge, DoesNotActOnADrThatNobodyWantsMoved) {
  const Parametrisation p(seed_mud(), {e100}, {}, kCrsGauge);
  EXPECT_FALSE(p.gauged());
  EXPECT_EQ(p.at(std::vector<double>{0.1})->D_r(), 6.8e-7);
}

TEST(Gauge, CrsMakesOcrOneOnTheReferenceIsotach) {
  const Parametrisation p(seed_mud(), {e100, lambda, D_r}, {}, kCrsGauge);
  EXPECT_TRUE(p.gauged());
  EXPECT_EQ(p.free(), (std::vector{e100, lambda}));
  const auto parameters = p.at(std::vector<double>{0.2, std::log(0.12)});
  ASSERT_TRUE(parameters.has_value());
  // in steady compression at the reference rate the law's viscous rate is D_r: OCR = (|D_vis|/D_r)^-I_v = 1
  const auto steady = integrators::steady_oedometric(*parameters, kCrsGauge.reference_rate);
  ASSERT_TRUE(steady.has_value());
  const model::Law<double> law(*parameters);
  const double p_B = 5e3;
  // stresses grow in proportion to p_B, so any p_B serves; sigma_a such that p_B+ = p_B
  model::Mandel<double> stress;
  stress << -1.0, -steady->K0, -steady->K0, 0.0, 0.0, 0.0;
  stress *= p_B / law.measures(stress).equivalent_pressure;
  const model::State<double> state{stress, law.void_ratio_at(p_B)};
  model::Mandel<double> strain_rate = model::Mandel<double>::Zero();
  strain_rate[0] = -kCrsGauge.reference_rate;
  const model::StateRate<double> rate = law.rate(state, strain_rate);
  // the state at OCR = 1 is steady: d ln sigma/dt = r/lambda for both stresses
  const double growth = kCrsGauge.reference_rate / parameters->lambda();
  EXPECT_NEAR(rate.stress[0] / stress[0] / growth, 1.0, 1e-9);
  EXPECT_NEAR(rate.stress[1] / stress[1] / growth, 1.0, 1e-9);
}

TEST(Gauge, DrIsProportionalToTheReferenceRateAndBlindToE100) {
  const auto D_r_at = [](double reference_rate, double log_e100) {
    const Parametrisation p(seed_mud(), {e100, D_r}, {}, {datasets::Gauge::crs_rate, reference_rate});
    return p.at(std::vector<double>{log_e100})->D_r();
  };
  EXPECT_NEAR(D_r_at(1e-5, 0.3) / D_r_at(1e-6, 0.3), 10.0, 1e-12);
  EXPECT_DOUBLE_EQ(D_r_at(1e-6, 0.3), D_r_at(1e-6, 0.9));
}

TEST(Tangent, IsTheDerivativeOfTheParameters) {
  const Parametrisation p(seed_mud(), {e100, lambda, kappa, C_1, phi_c, D_r}, {}, kCrsGauge);
  const std::vector<double>& x = p.start();
  const auto tangent = p.tangent(x);
  ASSERT_TRUE(tangent.has_value());
  constexpr double kStep = 1e-5;
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<double> up = x;
    std::vector<double> down = x;
    up[k] += kStep;
    down[k] -= kStep;
    const auto above = p.at(up);
    const auto below = p.at(down);
    for (const auto& parameter : model::kParameterTable) {
      const double value = seed_mud()[parameter.id];
      const double scale = value > 0.0 ? value : 1.0;  // C_2 and C_3 are zero and stay so
      const double expected = ((*above)[parameter.id] - (*below)[parameter.id]) / (2.0 * kStep);
      const double got =
          tangent->derivative(static_cast<Eigen::Index>(parameter.id), static_cast<Eigen::Index>(k));
      EXPECT_NEAR(got / scale, expected / scale, 1e-7) << parameter.name << ", coordinate " << k;
    }
  }
  // lambda moves D_r through the gauge, e100 does not
  EXPECT_GT(std::abs(tangent->derivative(static_cast<Eigen::Index>(D_r), 1)), 1e-9);
  EXPECT_EQ(tangent->derivative(static_cast<Eigen::Index>(D_r), 0), 0.0);
}

}  // namespace
}  // namespace isotach::calibration
