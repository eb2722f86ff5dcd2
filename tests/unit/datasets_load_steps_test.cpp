// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Stress-controlled records: where steps begin, what is left out, and stages that contradict the movement.
#include <gtest/gtest.h>

#include "datasets/oedometer.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

class StepsFile : public testing::Test {
 protected:
  OedometerRecord read(std::string_view content) const {
    return read_oedometer(folder_.write("il.csv", content), {0.02, std::nullopt},
                          {Control::stress, std::nullopt});
  }
  TemporaryFolder folder_;
};

TEST_F(StepsFile, AStepBeginsAtTheRowAtTheMomentOfLoading) {
  const auto record = read(
      "time_s,axial_strain,axial_stress_kPa\n"
      "0,0,10\n60,0.01,10\n86400,0.02,10\n"               // lines 2 to 4
      "86400,0.02,20\n86460,0.03,20\n"                    // 5, 6
      "172800,0.05,20\n172800,0.05,5\n172900,0.04,5\n");  // 7 to 9
  EXPECT_EQ(record.control, Control::stress);
  ASSERT_EQ(record.rows.size(), 5U);
  ASSERT_EQ(record.steps.size(), 3U);
  EXPECT_EQ(record.steps[0].begin, 0.0);
  EXPECT_EQ(record.steps[0].first, 0U);
  EXPECT_EQ(record.steps[0].count, 2U);
  EXPECT_EQ(record.steps[1].begin, 86400.0);
  EXPECT_EQ(record.steps[1].first, 2U);
  EXPECT_DOUBLE_EQ(record.steps[1].load, 20e3);
  EXPECT_EQ(record.steps[1].stage, Stage::load);
  EXPECT_EQ(record.steps[2].begin, 172800.0);
  EXPECT_EQ(record.steps[2].count, 1U);
  EXPECT_EQ(record.steps[2].stage, Stage::unload);
  EXPECT_EQ(record.rows[4].stage, Stage::unload);
  ASSERT_EQ(record.notes.size(), 1U);  // one for the file
  EXPECT_EQ(record.notes[0].line, 2U);
  EXPECT_NE(record.notes[0].what.find("3 readings at the very moment of loading left out"),
            std::string::npos);
}

TEST_F(StepsFile, WithoutSuchARowItBeginsAtTheRowBefore) {
  const auto record =
      read("time_s,axial_strain,axial_stress_kPa\n30,0.01,10\n90,0.02,10\n150,0.03,20\n200,0.04,20\n");
  ASSERT_EQ(record.steps.size(), 2U);
  EXPECT_EQ(record.steps[0].begin, 0.0);
  EXPECT_EQ(record.steps[0].count, 2U);
  EXPECT_EQ(record.steps[1].begin, 90.0);
  EXPECT_EQ(record.steps[1].count, 2U);
  EXPECT_TRUE(record.notes.empty());
}

TEST_F(StepsFile, TheStepColumnAndTheStageBeginStepsToo) {
  const auto by_column =
      read("time_s,axial_strain,axial_stress_kPa,step\n1,0.01,10,a\n2,0.02,10,a\n3,0.03,10,b\n4,0.04,10,b\n");
  ASSERT_EQ(by_column.steps.size(), 2U);
  EXPECT_EQ(by_column.steps[1].begin, 2.0);
  EXPECT_TRUE(by_column.unknown_columns.empty());
  // a hold belongs to the step it follows; 0.05 % of the load is reading noise, 0.2 % is not
  const auto by_stage = read(
      "time_s,axial_strain,axial_stress_kPa,stage\n1,0.01,10,load\n2,0.02,10.005,hold\n3,0.021,10,load\n"
      "4,0.02,10,unload\n5,0.019,10.02,unload\n");
  ASSERT_EQ(by_stage.steps.size(), 3U);
  EXPECT_EQ(by_stage.steps[0].count, 3U);
  EXPECT_NEAR(by_stage.steps[0].load, 10001.6667, 1e-3);
  EXPECT_EQ(by_stage.steps[1].stage, Stage::unload);
}

TEST_F(StepsFile, ARecordedStageThatContradictsTheMovementIsPutRightAndNamed) {
  const auto record = read(
      "time_s,axial_strain,axial_stress_kPa,stage\n1,0.01,10,unload\n2,0.02,20,load\n3,0.01,10,load\n"
      "4,0.005,5,unload\n");
  ASSERT_EQ(record.steps.size(), 4U);
  EXPECT_EQ(record.steps[0].stage, Stage::load);
  EXPECT_EQ(record.steps[2].stage, Stage::unload);
  EXPECT_EQ(record.steps[3].stage, Stage::unload);
  ASSERT_EQ(record.notes.size(), 2U);
  EXPECT_EQ(record.notes[0].line, 2U);
  EXPECT_NE(record.notes[0].what.find("step 1 is recorded as unload but read as load: its load is 10 kPa, it "
                                      "is the first, and the strain grows by 1 %"),
            std::string::npos)
      << record.notes[0].what;
  EXPECT_NE(record.notes[1].what.find("step 3 is recorded as load but read as unload"), std::string::npos);
}

TEST_F(StepsFile, RowsThatStepBackAndStepsWithoutReadingsAreNamed) {
  const auto record = read(
      "time_s,axial_strain,axial_stress_kPa\n1,0.01,10\n3,0.02,10\n2,0.02,10\n3,0.02,20\n3,0.02,40\n4,0.03,"
      "40\n"
      "5,0.03,-1\n");
  ASSERT_EQ(record.steps.size(), 2U);
  EXPECT_DOUBLE_EQ(record.steps[1].load, 40e3);
  EXPECT_EQ(record.steps[1].begin, 3.0);
  ASSERT_EQ(record.notes.size(), 4U);
  EXPECT_EQ(record.notes[0].what, "dropped: time 2 s is not after 3 s");
  EXPECT_EQ(record.notes[1].what, "step 2 left out: it has no reading under its load");
  EXPECT_EQ(record.notes[2].what, "dropped: axial stress -1 kPa is not positive");
  EXPECT_NE(record.notes[3].what.find("2 readings at the very moment"), std::string::npos);
}

TEST_F(StepsFile, TimesBeforeTheStartAndTooFewRowsAreRefused) {
  expect_input_error(
      [&] { static_cast<void>(read("time_s,axial_strain,axial_stress_kPa\n-1,0,10\n1,0.1,10\n")); },
      {"il.csv:2: column time_s: -1 is before the start"});
  expect_input_error(
      [&] { static_cast<void>(read("time_s,axial_strain,axial_stress_kPa\n0,0,10\n1,0.1,10\n2,0.1,10\n")); },
      {"rows: 2 usable of 3", "at least 3"});
}

}  // namespace
}  // namespace isotach::datasets
