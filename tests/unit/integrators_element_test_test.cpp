// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Element tests: rows, times, targets and strains along stages, what rows cost, and where a failure is
// reported. The physics of whole tests is in verification/checks_element_tests_test.cpp.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <vector>

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
    EXPECT_DOUBLE_EQ(row.overconsolidation_ratio, law.overconsolidation_ratio(row.state));
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

TEST(ElementTest, TimesOfManyStagesAreRightToRoundOff) {
  const std::vector<Stage> stages(1000, stage(kLoad, 0.1, 1));
  const auto rows = run_element_test(Law(set_a()), kStart, stages);
  ASSERT_TRUE(rows);
  // 0.1 is not a binary fraction: a plain sum of a thousand of them is off by 1.4e-12
  EXPECT_DOUBLE_EQ(rows->back().time, 100.0);
}

TEST(ElementTest, AFirstRowSpacesTheRowsByAConstantFactor) {
  Stage hold = stage(Vector6::Zero(), 1e6, 6);
  hold.first_row = 10.0;
  const auto rows = run_element_test(Law(set_a()), kStart, {stage(kLoad, 1e3, 1), hold});
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 8U);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR((*rows)[static_cast<std::size_t>(2 + i)].time, 1e3 + std::pow(10.0, 1.0 + i), 1e-8);
  }
}

TEST(ElementTest, TargetsAreReachedAtTheEndOfTheStageByEveryMethod) {
  const Law law(set_a(0.1));
  Stage second = stage(Vector6::Zero(), 2e4, 5);
  second.increment.stress_controlled[0] = true;
  second.target[0] = -150e3;
  second.target[1] = -0.002;  // strain since the start of the test
  second.target[3] = 0.001 * std::numbers::sqrt2;
  for (const Method method : kMethods) {
    Options options;  // default tolerances: what is prescribed does not depend on them
    options.method = method;
    const auto rows =
        run_element_test(law, kStart, {stage(compression_rate(1e-6, 1e-6, 0.0), 1e3, 2), second}, options);
    ASSERT_TRUE(rows) << name(method) << ": " << rows.error().failure.message();
    const ElementRow& begin = (*rows)[2];
    for (std::size_t i = 3; i <= 7; ++i) {
      const ElementRow& row = (*rows)[i];
      const double part = static_cast<double>(i - 2) / 5.0;  // linear in time
      EXPECT_NEAR(row.state.stress[0], begin.state.stress[0] + part * (-150e3 - begin.state.stress[0]),
                  1e-9 * 150e3)
          << name(method);
      EXPECT_NEAR(row.strain[1], -0.001 - 0.001 * part, 1e-13) << name(method);
      EXPECT_NEAR(row.strain[3], 0.001 * std::numbers::sqrt2 * part, 1e-13) << name(method);
    }
  }
}

TEST(ElementTest, RowsCostNoMoreThanTheStepsTheyCut) {
  const Law law(set_a());
  for (const Method method : {Method::fellin_ostermann, Method::cvode}) {
    auto options = tests::tight(method);
    options.fellin_ostermann.relative = 1e-8;
    const auto cost = [&](int rows) {
      return run_element_test(law, kStart, {stage(kLoad, 1e5, rows)}, options)
          .value()
          .back()
          .statistics.evaluations;
    };
    // each row ends one step early, of two evaluations with Fellin-Ostermann, and of none with CVODE
    EXPECT_LE(cost(100), cost(1) + 2 * 100) << name(method);
    EXPECT_GT(cost(1), 100) << name(method);
  }
}

TEST(ElementTest, StopsBeforeTheNextRowAndTellsOfEachRow) {
  const Law law(set_a());
  std::atomic<bool> stop = false;
  std::vector<double> times;
  ElementWatch watch;
  watch.stop = &stop;
  watch.progress = [&](double time) {
    times.push_back(time);
    stop = time >= 2e3;
  };
  const auto rows = run_element_test(law, kStart, {stage(kLoad, 1e4, 10)}, {}, watch);
  ASSERT_FALSE(rows);
  EXPECT_TRUE(rows.error().interrupted);
  EXPECT_EQ(times, (std::vector{0.0, 1e3, 2e3}));
  EXPECT_EQ(rows.error().rows.size(), 3U);
  EXPECT_EQ(rows.error().time, 2e3);
}

TEST(ElementTest, FailureSaysStageAndTimeAndKeepsTheRowsBefore) {
  const Law law(set_a());
  for (const Method method : kMethods) {
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

TEST(ElementTest, FirstRowsAndTargetsOutOfRangeAreInputErrors) {
  const Law law(set_a());
  Stage first_row = stage(kLoad, 1e3, 3);
  for (const double bad : {-1.0, 1e3, 2e3, std::nan("")}) {
    first_row.first_row = bad;
    EXPECT_THROW((void)run_element_test(law, kStart, {first_row}), std::invalid_argument) << bad;
  }
  Stage timeless = stage(kLoad, 0.0, 1);
  timeless.target[0] = 0.1;
  EXPECT_THROW((void)run_element_test(law, kStart, {timeless}), std::invalid_argument);
  Stage infinite = stage(kLoad, 1e3, 1);
  infinite.target[0] = HUGE_VAL;
  EXPECT_THROW((void)run_element_test(law, kStart, {infinite}), std::invalid_argument);
}

}  // namespace
}  // namespace isotach::integrators
