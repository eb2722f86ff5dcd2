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

/// Knows only which local quantities it has.
class WithLocals final : public experiments::Experiment {
 public:
  WithLocals(std::string name, std::vector<experiments::LocalQuantity> locals, bool held_out = false)
      : name_(std::move(name)), locals_(std::move(locals)), held_out_(held_out) {}
  const std::string& name() const override { return name_; }
  bool held_out() const override { return held_out_; }
  const experiments::Values& measured() const override { return none_; }
  std::string_view quantity() const override { return ""; }
  const experiments::Values& noise() const override { return none_; }
  std::vector<experiments::LocalQuantity> locals() const override { return locals_; }
  tl::expected<experiments::Values, experiments::PredictionFailure> predict(
      const model::Parameters<double>&, std::span<const double>) const override {
    return none_;
  }

 private:
  std::string name_;
  std::vector<experiments::LocalQuantity> locals_;
  bool held_out_;
  experiments::Values none_;
};

// Two tests and one held out: K0 is the first's own, the effect's two parameters are of all three.
class SharedEffects : public ::testing::Test {
 protected:
  const effects::ParameterRef delta_ = *effects::find_parameter("seating.delta_m");
  const effects::ParameterRef sigma_s_ = *effects::find_parameter("seating.sigma_s_kPa");
  const experiments::LocalQuantity K0_{"K0", 0.8, 0.15, 2.0, false, std::nullopt};
  const experiments::LocalQuantity delta_local_{"seating.delta_m", 2e-4,  0.0, 5e-3, false,
                                                std::nullopt,      delta_};
  const experiments::LocalQuantity sigma_local_{"seating.sigma_s_kPa", 15e3,    1e2, 1e6, true,
                                                std::nullopt,          sigma_s_};
  const Experiments tests_{std::make_shared<WithLocals>("a", std::vector{K0_, delta_local_, sigma_local_}),
                           std::make_shared<WithLocals>("b", std::vector{delta_local_, sigma_local_}),
                           std::make_shared<WithLocals>("c", std::vector{delta_local_, sigma_local_}, true)};
};

TEST_F(SharedEffects, AreOneCoordinateEachOverTheirTypicalValueOrAsLogarithm) {
  CoordinateSettings settings;
  settings.effects = {{sigma_s_, datasets::Bounds{5e3, 50e3}}};
  const Parametrisation p(seed_mud(), {lambda}, settings, kNoGauge, tests_);
  ASSERT_EQ(p.size(), 4);
  EXPECT_EQ(p.coordinates()[1].name, "seating.delta_m");
  EXPECT_EQ(p.coordinates()[2].name, "seating.sigma_s_kPa");
  EXPECT_EQ(p.coordinates()[3].name, "a: K0");
  EXPECT_DOUBLE_EQ(p.start()[1], 2.0);  // of 1e-4 m
  EXPECT_DOUBLE_EQ(p.upper()[1], 50.0);
  EXPECT_DOUBLE_EQ(p.start()[2], std::log(15e3));
  EXPECT_DOUBLE_EQ(p.lower()[2], std::log(5e3));
  EXPECT_DOUBLE_EQ(p.upper()[2], std::log(50e3));
}

TEST_F(SharedEffects, ReachEveryTestHeldOutOrNot) {
  const Parametrisation p(seed_mud(), {lambda}, {}, kNoGauge, tests_);
  const std::vector<double> x{std::log(0.15), 3.0, std::log(20e3), 0.7};
  const std::vector<double> a = p.local_at(x, 0);
  ASSERT_EQ(a.size(), 3);
  EXPECT_DOUBLE_EQ(a[0], 0.7);
  EXPECT_DOUBLE_EQ(a[1], 3e-4);
  EXPECT_NEAR(a[2], 20e3, 1e-9 * 20e3);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(p.local_at(x, i), (std::vector{a[1], a[2]}));
  }
  const WithLocals stranger("d", {K0_, delta_local_});
  EXPECT_EQ(p.local_of(stranger, x), (std::vector{0.8, a[1]}));
}

TEST_F(SharedEffects, HaveTheSlopeOfTheirCoordinateInEveryTest) {
  const Parametrisation p(seed_mud(), {lambda}, {}, kNoGauge, tests_);
  const std::vector<double> x{std::log(0.15), 3.0, std::log(20e3), 0.7};
  const auto tangent = p.tangent(x);
  ASSERT_TRUE(tangent);
  const Eigen::MatrixXd a = p.directions(*tangent, x, 0);
  const Eigen::MatrixXd b = p.directions(*tangent, x, 1);
  constexpr auto kFirst = static_cast<Eigen::Index>(model::kParameterCount);
  EXPECT_EQ(a(kFirst, 3), 1.0);
  EXPECT_DOUBLE_EQ(a(kFirst + 1, 1), 1e-4);
  EXPECT_NEAR(a(kFirst + 2, 2), 20e3, 1e-9 * 20e3);
  EXPECT_DOUBLE_EQ(b(kFirst, 1), 1e-4);
  EXPECT_NEAR(b(kFirst + 1, 2), 20e3, 1e-9 * 20e3);
  EXPECT_EQ(b.col(3).norm(), 0.0);
  EXPECT_EQ((a.bottomRows(3).array() != 0.0).count(), 3);
  EXPECT_EQ((b.bottomRows(2).array() != 0.0).count(), 2);
}

}  // namespace
}  // namespace isotach::calibration
