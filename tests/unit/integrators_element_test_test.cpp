// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Element tests: rows, times and strains along stages, and where a failure is reported.
#include <gtest/gtest.h>

#include <stdexcept>

#include "integrators/element_test.hpp"
#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::set_a;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

const Vector6 kLoad = compression_rate(1e-6, 0.0, 0.0);
const State kStart{stress_kPa(100.0, 65.0, 65.0), 1.5};

Stage stage(const Vector6& strain_rate, double duration, int rows) {
  return {"stage", strain_increment<double>(strain_rate, duration), rows};
}

/// Isotropic stress reduced by 1 kPa/s: reaches p = 0.
Stage into_tension(int rows) {
  Stage result{"unload", {}, rows};
  result.increment.duration = 400.0;
  result.increment.stress_rate.head<3>().setConstant(1e3);
  result.increment.stress_controlled.fill(true);
  return result;
}

TEST(ElementTest, RowsStandAtEqualIntervalsOfEachStageAfterTheStart) {
  const Law law(set_a());
  const auto rows =
      run_element_test(law, kStart, {stage(kLoad, 3e4, 3), stage(-kLoad, 1e3, 1), stage(kLoad, 2e4, 4)});
  ASSERT_TRUE(rows);
  const std::vector<double> times{0.0, 1e4, 2e4, 3e4, 3.1e4, 3.6e4, 4.1e4, 4.6e4, 5.1e4};
  const std::vector<std::size_t> stages{0, 0, 0, 0, 1, 2, 2, 2, 2};
  // strain by hand: 1e-6 /s loading but for 1e3 s of unloading
  const std::vector<double> strain{0.0, 0.01, 0.02, 0.03, 0.029, 0.034, 0.039, 0.044, 0.049};
  ASSERT_EQ(rows->size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const ElementRow& row = (*rows)[i];
    EXPECT_DOUBLE_EQ(row.time, times[i]);
    EXPECT_EQ(row.stage, stages[i]);
    EXPECT_NEAR(row.strain[0], -strain[i], 1e-14);
    EXPECT_NEAR(row.state.void_ratio, 2.5 * std::exp(-strain[i]) - 1.0, 1e-5);  // default tolerance 1e-6
    EXPECT_EQ(row.overconsolidation_ratio, law.overconsolidation_ratio(row.state));
  }
  EXPECT_EQ(rows->front().state.stress, kStart.stress);
}

TEST(ElementTest, EndDoesNotDependOnTheNumberOfRows) {
  const Law law(set_a(0.1));
  const auto options = tests::tight(Method::fellin_ostermann);
  const auto one = run_element_test(law, kStart, {stage(kLoad, 5e4, 1)}, options);
  const auto many = run_element_test(law, kStart, {stage(kLoad, 5e4, 50)}, options);
  ASSERT_TRUE(one && many);
  EXPECT_LE((one->back().state.stress - many->back().state.stress).norm(),
            2e-9 * one->back().state.stress.norm());
}

TEST(ElementTest, NoStagesGiveTheStartAndZeroDurationRepeatsIt) {
  const Law law(set_a());
  const auto none = run_element_test(law, kStart, {});
  ASSERT_TRUE(none);
  EXPECT_EQ(none->size(), 1U);
  const auto still = run_element_test(law, kStart, {stage(kLoad, 0.0, 2)});
  ASSERT_TRUE(still);
  ASSERT_EQ(still->size(), 3U);
  EXPECT_EQ(still->back().state.stress, kStart.stress);
  EXPECT_EQ(still->back().time, 0.0);
}

TEST(ElementTest, FailureSaysStageAndTimeAndKeepsTheRowsBefore) {
  const Law law(set_a());
  for (const Method method : {Method::fellin_ostermann, Method::cvode}) {
    Options options;
    options.method = method;
    const State start{stress_kPa(100.0, 100.0, 100.0), 0.2};
    const auto rows =
        run_element_test(law, start, {stage(Vector6::Zero(), 1e3, 2), into_tension(8)}, options);
    ASSERT_FALSE(rows);
    // without creep p still is 100 kPa at 1000 s and vanishes 100 s later, in the third of the rows of 50 s
    // or at the end of the second
    EXPECT_EQ(rows.error().stage, 1U);
    EXPECT_NEAR(rows.error().time, 1100.0, 1.0);
    EXPECT_GE(rows.error().rows.size(), 4U);
    EXPECT_LE(rows.error().rows.size(), 5U);
    EXPECT_NEAR(tests::p_kPa(rows.error().rows[3].state), 50.0, 1e-9);
    EXPECT_NEAR(rows.error().time, rows.error().rows.back().time + rows.error().failure.time, 1e-12);
  }
}

TEST(ElementTest, StartOutsideTheDomainFailsBeforeAnyRow) {
  const auto rows =
      run_element_test(Law(set_a()), {stress_kPa(-1.0, -1.0, -1.0), 1.5}, {stage(kLoad, 1e3, 1)});
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().failure.kind, FailureKind::outside_domain);
  EXPECT_EQ(rows.error().time, 0.0);
  EXPECT_TRUE(rows.error().rows.empty());
}

TEST(ElementTest, RowsAndDurationOutOfRangeAreInputErrorsThatNameTheStage) {
  const Law law(set_a());
  for (const Stage& bad : {stage(kLoad, 1e3, 0), stage(kLoad, 1e3, -2), stage(kLoad, -1.0, 1),
                           stage(kLoad, std::nan(""), 1), stage(kLoad, HUGE_VAL, 1)}) {
    Stage named = bad;
    named.name = "shear";
    try {
      (void)run_element_test(law, kStart, {named});
      ADD_FAILURE() << "accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("stage \"shear\""), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace isotach::integrators
