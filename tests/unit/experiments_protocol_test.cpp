// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What drives the model and what is compared: creep holds, load steps, the end of primary consolidation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/oedometer_experiment.hpp"
#include "experiments/primary_consolidation.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::experiments {
namespace {

using datasets::Stage;

datasets::OedometerTest with_hold() {
  datasets::OedometerTest test{};
  test.name = "hold";
  test.record.file = "hold.csv";
  test.record.rows = {{2, 100.0, 0.02, 10e3, Stage::load, {}, {}, {}},
                      {3, 300.0, 0.04, 20e3, Stage::load, {}, {}, {}},
                      {4, 500.0, 0.050, 19e3, Stage::hold, {}, {}, {}},
                      {5, 900.0, 0.055, 21e3, Stage::hold, {}, {}, {}},
                      {6, 1000.0, 0.065, 25e3, Stage::load, {}, {}, {}}};
  test.height = 0.02;
  test.void_ratio = 2.4;
  test.initial_K0 = 0.8;
  test.noise = {0.03, 400.0, 1e-3};
  return test;
}

// the apparatus held the mean, 20 kPa; the answer is the strain since 0.04
TEST(Protocol, RecordedHoldIsDrivenByItsMeanStressAndComparedInStrain) {
  const OedometerExperiment experiment(with_hold());
  const auto& protocol = experiment.protocol();
  ASSERT_EQ(protocol.values.size(), 4U);
  EXPECT_EQ(protocol.values[0].kind, ValueKind::log_stress);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(protocol.values[i].kind, ValueKind::strain);
    EXPECT_TRUE(protocol.steps[i].stress_controlled);
    EXPECT_DOUBLE_EQ(protocol.steps[i].amount, 20e3);
    EXPECT_EQ(experiment.noise()[i], 1e-3);
  }
  EXPECT_NEAR(experiment.measured()[1], 0.010, 1e-15);
  EXPECT_NEAR(experiment.measured()[2], 0.015, 1e-15);
  EXPECT_FALSE(protocol.steps[3].stress_controlled);
  EXPECT_NEAR(protocol.steps[3].amount, std::log(0.945 / 0.935), 1e-14);
  const auto channels = experiment.channels();
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0].values, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(channels[0].chains, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(channels[1].values, (std::vector<std::size_t>{1, 2}));
}

TEST(Protocol, PathAndValuesAgreeWithThePredictionAndWithCvode) {
  const OedometerExperiment experiment(with_hold());
  const auto parameters = tests::seed_mud();
  const auto predicted = experiment.predict(parameters, {});
  ASSERT_TRUE(predicted) << predicted.error().message;
  for (const Route route : {Route::fellin_ostermann, Route::cvode}) {
    const auto path = experiment.path(parameters, {}, route);
    ASSERT_TRUE(path) << path.error().message;
    const Values values = experiment.values_of(*path);
    ASSERT_EQ(values.size(), predicted->size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i], (*predicted)[i], route == Route::cvode ? 2e-4 : 1e-12) << i;
    }
  }
}

/// Two loads and an unloading of a day, readings at 60 s, 600 s, 6000 s and a day.
datasets::OedometerTest incremental() {
  datasets::OedometerTest test{};
  test.name = "loads";
  test.record.file = "loads.csv";
  test.record.control = datasets::Control::stress;
  const double loads[] = {20e3, 40e3, 20e3};
  const double strains[3][4] = {
      {0.01, 0.02, 0.025, 0.03}, {0.04, 0.06, 0.07, 0.08}, {0.079, 0.078, 0.077, 0.077}};
  double begin = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Stage stage = k == 2 ? Stage::unload : Stage::load;
    test.record.steps.push_back({begin, loads[k], stage, test.record.rows.size(), 4});
    int i = 0;
    for (const double after : {60.0, 600.0, 6000.0, 86400.0}) {
      test.record.rows.push_back(
          {test.record.rows.size() + 2, begin + after, strains[k][i++], loads[k], stage, {}, {}, {}});
    }
    begin += 86400.0;
  }
  test.height = 0.02;
  test.void_ratio = 2.4;
  test.initial_K0 = 0.8;
  test.end_of_primary = {datasets::EndOfPrimary::Rule::given, 500.0};
  test.noise = {0.03, 400.0, 1e-3};
  return test;
}

TEST(Protocol, WithoutAnInitialStressTheFirstLoadIsWhereStepsBegin) {
  const OedometerExperiment experiment(incremental());
  const auto& start = experiment.protocol().start;
  EXPECT_EQ(start.time, 86400.0);
  EXPECT_EQ(start.axial_stress, 20e3);
  EXPECT_EQ(start.axial_strain, 0.03);
  EXPECT_NEAR(start.void_ratio, 3.4 * 0.97 - 1.0, 1e-14);
  // of each step the readings from 500 s on
  ASSERT_EQ(experiment.measured().size(), 6U);
  EXPECT_EQ(experiment.measured()[0], 0.06);
  EXPECT_EQ(experiment.measured()[3], 0.078);
  // each step a chain of its own: what is missed of one says nothing of the next
  EXPECT_EQ(experiment.channels()[0].chains, (std::vector<std::size_t>{0, 3}));
  // mean rate of the load of 40 kPa, from 0.03 to 0.08 in a day
  EXPECT_NEAR(*experiment.protocol().first_loading_rate, std::log(0.97 / 0.92) / 86400.0, 1e-15);
}

// linear in time until 500 s, constant from then on; readings in between keep their places
TEST(Protocol, LoadIsBroughtOnUntilTheEndOfPrimary) {
  const OedometerExperiment experiment(incremental());
  const auto& steps = experiment.protocol().steps;
  EXPECT_DOUBLE_EQ(steps[0].duration, 60.0);
  EXPECT_DOUBLE_EQ(steps[0].amount, 20e3 + 20e3 * 60.0 / 500.0);
  EXPECT_DOUBLE_EQ(steps[1].duration, 440.0);
  EXPECT_DOUBLE_EQ(steps[1].amount, 40e3);
  EXPECT_EQ(steps[1].row, kNoRow);
  EXPECT_DOUBLE_EQ(steps[2].duration, 100.0);
  EXPECT_DOUBLE_EQ(steps[2].amount, 40e3);
}

TEST(Protocol, WithAnInitialStressAllStepsAreFollowed) {
  datasets::OedometerTest test = incremental();
  test.initial_axial_stress = 5e3;
  const OedometerExperiment experiment(test);
  EXPECT_EQ(experiment.protocol().start.time, 0.0);
  EXPECT_EQ(experiment.protocol().start.axial_stress, 5e3);
  EXPECT_EQ(experiment.measured().size(), 9U);
}

TEST(Protocol, NothingLeftToCompareIsRefused) {
  datasets::OedometerTest test = incremental();
  test.record.steps.resize(1);
  EXPECT_THROW(OedometerExperiment{test}, std::invalid_argument);
}

// de0 by OCR: p_B = OCR p_B+ at the start; and K0 as the first local quantity
TEST(Protocol, FreeStartEntersAsLocalQuantities) {
  datasets::OedometerTest test = with_hold();
  test.free_K0 = {true, 0.05};
  test.initial_ocr = 1.5;
  test.free_ocr = {true, {}};
  const OedometerExperiment experiment(test);
  const auto locals = experiment.locals();
  ASSERT_EQ(locals.size(), 2U);
  EXPECT_EQ(locals[0].name, "K0");
  EXPECT_EQ(locals[1].name, "OCR");
  const auto path = experiment.path(tests::seed_mud(), std::vector{0.7, 1.8}, Route::fellin_ostermann);
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_NEAR(path->front().K0, 0.7, 1e-12);
  EXPECT_NEAR(path->front().ocr, 1.8, 1e-12);

  Eigen::MatrixXd directions =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model::kParameterCount) + 2, 2);
  directions.bottomRows(2).setIdentity();
  const std::vector<double> at{0.7, 1.8};
  const auto exact = experiment.linearise(tests::seed_mud(), at, directions);
  ASSERT_TRUE(exact);
  for (int k = 0; k < 2; ++k) {
    const double h = 1e-3;
    std::vector<double> low = at;
    std::vector<double> high = at;
    low[static_cast<std::size_t>(k)] -= h;
    high[static_cast<std::size_t>(k)] += h;
    const auto below = experiment.predict(tests::seed_mud(), low);
    const auto above = experiment.predict(tests::seed_mud(), high);
    for (std::size_t i = 0; i < below->size(); ++i) {
      EXPECT_NEAR(exact->jacobian(static_cast<Eigen::Index>(i), k), ((*above)[i] - (*below)[i]) / (2.0 * h),
                  5e-3 * std::abs(exact->jacobian(0, k)) + 1e-4)
          << i << ", " << k;
    }
  }
}

/// Terzaghi's average degree of consolidation at the time factor T, by its series.
double terzaghi(double T) {
  double rest = 0.0;
  for (int m = 0; m < 200; ++m) {
    const double M = 0.5 * std::numbers::pi * (2 * m + 1);
    rest += 2.0 / (M * M) * std::exp(-M * M * T);
  }
  return 1.0 - rest;
}

struct Curve {
  std::vector<double> times;
  std::vector<double> strains;
};

/// Primary consolidation of 5 % with 90 % (T = 0.848) after an hour, and creep of 0.2 % a ln(t) behind it.
Curve consolidation(double from, double creep) {
  Curve curve;
  for (double t = from; t <= 86400.0; t *= 1.15) {
    const double T = 0.848 * t / 3600.0;
    curve.times.push_back(t);
    curve.strains.push_back(0.05 * terzaghi(T) + creep * std::log1p(T));
  }
  return curve;
}

// from 90 %, at T = 0.848, to 99.8 % at T = 2.5: between them the primary part ends for any reader of the
// curve
TEST(PrimaryConsolidation, BothConstructionsFindTheEndOfTerzaghisCurve) {
  const Curve curve = consolidation(5.0, 0.002);
  const auto taylor = end_of_primary_taylor(curve.times, curve.strains, 0.0);
  const auto casagrande = end_of_primary_casagrande(curve.times, curve.strains);
  ASSERT_TRUE(taylor) << taylor.error();
  ASSERT_TRUE(casagrande) << casagrande.error();
  const double hour = 3600.0 / 0.848;
  EXPECT_GT(*taylor, 0.848 * hour);
  EXPECT_LT(*taylor, 2.5 * hour);
  EXPECT_GT(*casagrande, 0.7 * hour);
  EXPECT_LT(*casagrande, 2.5 * hour);
}

TEST(PrimaryConsolidation, SwellingIsReadLikeCompression) {
  Curve curve = consolidation(5.0, 0.002);
  const auto up = end_of_primary_taylor(curve.times, curve.strains, 0.0);
  for (double& strain : curve.strains) strain = 0.3 - strain;
  const auto down = end_of_primary_taylor(curve.times, curve.strains, 0.3);
  ASSERT_TRUE(up && down);
  EXPECT_EQ(*down, *up);
}

TEST(PrimaryConsolidation, SaysWhyItCannotBeFound) {
  const Curve late = consolidation(1800.0, 0.002);
  EXPECT_NE(end_of_primary_taylor(late.times, late.strains, 0.0).error().find("begin too late"),
            std::string::npos);
  const Curve few{{1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}};
  EXPECT_NE(end_of_primary_taylor(few.times, few.strains, 0.0).error().find("too few"), std::string::npos);
  EXPECT_FALSE(end_of_primary_casagrande(few.times, few.strains));
}

}  // namespace
}  // namespace isotach::experiments
