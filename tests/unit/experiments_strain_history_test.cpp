// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// commanded_strain: readings are averaged where the strain was held, and nowhere else.
#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "experiments/strain_history.hpp"

namespace isotach::experiments {
namespace {

using datasets::Stage;

struct Reading {
  double strain;
  Stage stage;
};

datasets::OedometerRecord record_of(std::initializer_list<Reading> readings, bool deduced) {
  datasets::OedometerRecord record;
  record.stages_deduced = deduced;
  double time = 0.0;
  for (const Reading& reading : readings) {
    time += 100.0;
    record.rows.push_back({record.rows.size() + 2, time, reading.strain, 1e4, reading.stage, {}, {}});
  }
  return record;
}

void expect_strains(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-15) << "row " << i;
}

// mean of 0.040, 0.046, 0.043, 0.039: the last row of the loading was read at the strain that is then held
TEST(CommandedStrain, RelaxationIsAveragedWithTheRowThatOpensIt) {
  const auto record = record_of({{0.02, Stage::load},
                                 {0.040, Stage::load},
                                 {0.046, Stage::relax},
                                 {0.043, Stage::relax},
                                 {0.039, Stage::relax},
                                 {0.06, Stage::load}},
                                false);
  expect_strains(commanded_strain(record), {0.02, 0.042, 0.042, 0.042, 0.042, 0.06});
}

// the record says hold: the stress is held, and the strain that creeps is the answer of the soil
TEST(CommandedStrain, RecordedHoldKeepsItsReadings) {
  const auto record = record_of(
      {{0.02, Stage::load}, {0.040, Stage::hold}, {0.046, Stage::hold}, {0.05, Stage::unload}}, false);
  EXPECT_FALSE(holds_strain(record, Stage::hold));
  expect_strains(commanded_strain(record), {0.02, 0.040, 0.046, 0.05});
}

// no stage column: a hold is known only by strains that stand still
TEST(CommandedStrain, DeducedHoldIsAveraged) {
  const auto record = record_of(
      {{0.010, Stage::load}, {0.030, Stage::load}, {0.033, Stage::hold}, {0.05, Stage::load}}, true);
  EXPECT_TRUE(holds_strain(record, Stage::hold));
  expect_strains(commanded_strain(record), {0.010, 0.0315, 0.0315, 0.05});
}

TEST(CommandedStrain, RelaxationAtTheBeginningHasNoRowBefore) {
  const auto record = record_of({{0.001, Stage::relax}, {0.003, Stage::relax}, {0.02, Stage::load}}, false);
  expect_strains(commanded_strain(record), {0.002, 0.002, 0.02});
}

TEST(CommandedStrain, EachHoldHasItsOwnMean) {
  const auto record = record_of({{0.01, Stage::load},
                                 {0.03, Stage::relax},
                                 {0.05, Stage::unload},
                                 {0.07, Stage::relax},
                                 {0.09, Stage::relax}},
                                false);
  expect_strains(commanded_strain(record), {0.02, 0.02, 0.07, 0.07, 0.07});
}

TEST(CommandedStrain, LoadingAndUnloadingKeepTheirReadings) {
  const auto record = record_of({{0.01, Stage::load}, {0.03, Stage::load}, {0.02, Stage::unload}}, true);
  EXPECT_FALSE(holds_strain(record, Stage::load));
  EXPECT_FALSE(holds_strain(record, Stage::unload));
  expect_strains(commanded_strain(record), {0.01, 0.03, 0.02});
}

// noise of reading does not turn the direction commanded: 0.033, 0.031 become their mean
TEST(CommandedStrain, StepsBackWhileLoadingAreEvenedOut) {
  const auto record = record_of({{0.02, Stage::load},
                                 {0.033, Stage::load},
                                 {0.031, Stage::load},
                                 {0.05, Stage::load},
                                 {0.045, Stage::unload},
                                 {0.046, Stage::unload},
                                 {0.03, Stage::unload}},
                                false);
  expect_strains(commanded_strain(record), {0.02, 0.032, 0.032, 0.05, 0.0455, 0.0455, 0.03});
}

}  // namespace
}  // namespace isotach::experiments
