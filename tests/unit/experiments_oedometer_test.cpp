// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// OedometerExperiment: start, strain steps, noise and rate of a small record, against hand arithmetic.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/oedometer_experiment.hpp"

namespace isotach::experiments {
namespace {

using datasets::Stage;

/// Loading to 40 kPa, a relaxation, unloading; noise of 3 %, 0.4 kPa and 1e-3 of strain.
datasets::OedometerTest small_test() {
  datasets::OedometerTest test{};
  test.name = "small";
  test.record.file = "small.csv";
  test.record.rows = {
      {2, 100.0, 0.02, 10e3, Stage::load, {}, {}},   {3, 300.0, 0.04, 20e3, Stage::load, {}, {}},
      {4, 500.0, 0.06, 40e3, Stage::load, {}, {}},   {5, 900.0, 0.06, 32e3, Stage::relax, {}, {}},
      {6, 950.0, 0.05, 16e3, Stage::unload, {}, {}}, {7, 1000.0, 0.04, 8e3, Stage::unload, {}, {}}};
  test.height = 0.02;
  test.void_ratio = 1.5;
  test.initial_K0 = 0.8;
  test.noise = {0.03, 400.0, 1e-3};
  return test;
}

model::Parameters<double> soft_mud(double I_v = 0.03) {
  model::ParameterValues<double> values;
  values.values = {1.358, 0.154, 0.0129, I_v, 6.8e-7, 14.2 * std::numbers::pi / 180.0, 0.03};
  return *model::Parameters<double>::create(values);
}

TEST(OedometerExperiment, WithoutAnInitialStressTheFirstRowIsTheStart) {
  const OedometerExperiment experiment(small_test());
  EXPECT_EQ(experiment.protocol().start.time, 100.0);
  EXPECT_EQ(experiment.protocol().start.axial_strain, 0.02);
  EXPECT_EQ(experiment.protocol().start.axial_stress, 10e3);
  EXPECT_NEAR(experiment.protocol().start.void_ratio, 2.5 * 0.98 - 1.0, 1e-15);
  ASSERT_EQ(experiment.values().size(), 5);
  EXPECT_EQ(experiment.row_of(experiment.values().front()).line, 3);
  EXPECT_EQ(experiment.measured().size(), 5);
  EXPECT_EQ(experiment.noise().size(), 5);
}

TEST(OedometerExperiment, InitialStressIsTheStartAtTimeAndStrainZero) {
  datasets::OedometerTest test = small_test();
  test.initial_axial_stress = 4e3;
  const OedometerExperiment experiment(test);
  EXPECT_EQ(experiment.protocol().start.time, 0.0);
  EXPECT_EQ(experiment.protocol().start.axial_strain, 0.0);
  EXPECT_EQ(experiment.protocol().start.axial_stress, 4e3);
  EXPECT_EQ(experiment.protocol().start.void_ratio, 1.5);
  ASSERT_EQ(experiment.values().size(), 6);
  EXPECT_EQ(experiment.protocol().steps[0].duration, 100.0);
  EXPECT_NEAR(experiment.protocol().steps[0].amount, -std::log(0.98), 1e-15);
}

TEST(OedometerExperiment, AFirstRowAtTimeZeroIsTheInitialStateItself) {
  datasets::OedometerTest test = small_test();
  test.initial_axial_stress = 4e3;
  test.record.rows.front() = {2, 0.0, 0.0, 4.1e3, Stage::load, {}, {}};
  const OedometerExperiment experiment(test);
  EXPECT_EQ(experiment.protocol().start.axial_stress, 4e3);
  ASSERT_EQ(experiment.values().size(), 5);
  EXPECT_EQ(experiment.protocol().steps[0].duration, 300.0);
}

TEST(OedometerExperiment, StepsAreLogarithmicAndKeepTheGrainsVolume) {
  const OedometerExperiment experiment(small_test());
  const double engineering[] = {0.04, 0.06, 0.06, 0.05, 0.04};
  double height = 0.98;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(experiment.protocol().steps[i].amount, std::log(height / (1.0 - engineering[i])), 1e-15);
    height = 1.0 - engineering[i];
    EXPECT_NEAR(experiment.void_ratio_of(experiment.row_of(experiment.values()[i])), 2.5 * height - 1.0,
                1e-14);
  }
  EXPECT_EQ(experiment.protocol().steps[2].duration, 400.0);
  EXPECT_EQ(experiment.protocol().steps[2].amount, 0.0);
}

TEST(OedometerExperiment, MeasuredIsTheLogarithmOfStress) {
  const OedometerExperiment experiment(small_test());
  EXPECT_DOUBLE_EQ(experiment.measured()[0], std::log(20e3));
  EXPECT_DOUBLE_EQ(experiment.measured()[4], std::log(8e3));
}

// Variances of ln(stress): 0.03^2, (0.4 kPa/stress)^2, and (1e-3 d ln(stress)/d(strain))^2 of the stage:
// ln(40/10)/0.04 = 34.65736 loading, none while the strain is held, ln(8/16)/0.01 = 69.31472 unloading.
TEST(OedometerExperiment, NoiseAddsStressFloorAndStrainInSquares) {
  datasets::OedometerTest test = small_test();
  test.initial_axial_stress = 4e3;  // so that all rows are compared
  const OedometerExperiment experiment(test);
  const double expected[] = {
      0.0608369,  // sqrt(9e-4 + 16e-4 + 12.01133e-4)
      0.0500113,  // sqrt(9e-4 + 4e-4 + 12.01133e-4)
      0.0469162,  // sqrt(9e-4 + 1e-4 + 12.01133e-4)
      0.0325000,  // sqrt(9e-4 + 1.5625e-4)
      0.0795583,  // sqrt(9e-4 + 6.25e-4 + 48.04530e-4)
      0.0905789,  // sqrt(9e-4 + 25e-4 + 48.04530e-4)
  };
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(experiment.noise()[i], expected[i], 5e-7) << "row " << i;
}

TEST(OedometerExperiment, ScaledResidualsAreInUnitsOfTheNoise) {
  const OedometerExperiment experiment(small_test());
  Values predicted = experiment.measured();
  predicted[1] += 2.0 * experiment.noise()[1];
  const Values scaled = experiment.scaled_residuals(predicted);
  EXPECT_EQ(scaled[0], 0.0);
  EXPECT_NEAR(scaled[1], 2.0, 1e-12);
}

// from height 0.98 at 100 s to 0.94 at 500 s; the second loading, twice as fast, does not count
TEST(OedometerExperiment, FirstLoadingRateIsThatOfItsEnds) {
  datasets::OedometerTest test = small_test();
  test.record.rows.push_back({8, 1100.0, 0.08, 30e3, Stage::load, {}, {}});
  const auto rate = OedometerExperiment(test).protocol().first_loading_rate;
  ASSERT_TRUE(rate);
  EXPECT_NEAR(*rate, std::log(0.98 / 0.94) / 400.0, 1e-15);
}

TEST(OedometerExperiment, FirstLoadingRateSkipsWhatComesBefore) {
  datasets::OedometerTest test = small_test();
  for (std::size_t i : {0U, 1U}) test.record.rows[i].stage = Stage::unload;
  test.record.rows[0].axial_strain = 0.05;
  const auto rate = OedometerExperiment(test).protocol().first_loading_rate;
  ASSERT_TRUE(rate);
  EXPECT_NEAR(*rate, std::log(0.96 / 0.94) / 200.0, 1e-15);
}

TEST(OedometerExperiment, NoLoadingHasNoRate) {
  datasets::OedometerTest test = small_test();
  for (auto& row : test.record.rows) row.stage = Stage::unload;
  EXPECT_FALSE(OedometerExperiment(test).protocol().first_loading_rate);
}

// compressed to 40 % of its height, 2.5 * 0.4 = 1.0: no void is left
TEST(OedometerExperiment, FailureNamesTheTestTheTimesAndTheLine) {
  datasets::OedometerTest test = small_test();
  test.record.rows.back() = {9, 1000.0, 0.61, 8e3, Stage::load, {}, {}};
  const auto prediction = OedometerExperiment(test).predict(soft_mud(), {});
  ASSERT_FALSE(prediction);
  const std::string& message = prediction.error().message;
  for (const char* part : {"small: ", "between time 950 s and 1000 s", "(line 9)", "integration failed"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
  }
  EXPECT_FALSE(prediction.error().interrupted);
}

TEST(OedometerExperiment, LineariseReturnsThePredictionItself) {
  const OedometerExperiment experiment(small_test());
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model::kParameterCount), 2);
  both(static_cast<Eigen::Index>(model::ParameterId::lambda), 0) = 1.0;
  both(static_cast<Eigen::Index>(model::ParameterId::I_v), 1) = 1.0;
  const auto values = experiment.predict(soft_mud(), {});
  const auto linearised = experiment.linearise(soft_mud(), {}, both);
  ASSERT_TRUE(values && linearised);
  EXPECT_EQ(linearised->jacobian.rows(), 5);
  EXPECT_EQ(linearised->jacobian.cols(), 2);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(linearised->values[i], (*values)[i], 1e-12);
}

}  // namespace
}  // namespace isotach::experiments
