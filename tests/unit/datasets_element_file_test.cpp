// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// read_element_file: values in SI and tension positive, stages written out, and mistakes named with their
// line.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "datasets/element_file.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

using integrators::Stage;

constexpr double kSqrt2 = std::numbers::sqrt2;

constexpr std::string_view kElement = R"([material]
e100 = 1.5
lambda = 0.1
kappa = 0.02
I_v = 0.05
D_r_per_s = 1e-6
phi_c_deg = 25
C_1 = 0
[state]
stress_kPa = [100, 65, 60, 5, -4, 3]
void_ratio = 1.5
[[stage]]
name = "mixed"
duration_s = 3e5
rows = 7
strain_rate_per_s = { 11 = 1e-6, 12 = 2e-6 }
strain = { 13 = 0.01 }
stress_rate_kPa_per_s = { 22 = -0.5 }
stress_kPa = { 33 = 80, 23 = 4 }
spin_per_s = { 12 = 2e-6, 23 = -1e-6 }
)";

class ElementFileTest : public testing::Test {
 protected:
  [[nodiscard]] ElementFile read(std::string_view content) const {
    return read_element_file(folder_.write("test.toml", content));
  }
  [[nodiscard]] ElementFile changed(std::string_view from, std::string_view to) const {
    return read(replaced(std::string(kElement), from, to));
  }
  void refused(std::string_view from, std::string_view to,
               std::initializer_list<std::string_view> parts) const {
    SCOPED_TRACE(to);
    expect_input_error([&] { static_cast<void>(changed(from, to)); }, parts);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ElementFileTest, ComesOutInSIAndTensionPositive) {
  const ElementFile test = read(kElement);
  EXPECT_FALSE(test.note.has_value());
  EXPECT_DOUBLE_EQ(test.material.kappa(), 0.02);
  EXPECT_EQ(test.start.void_ratio, 1.5);
  EXPECT_TRUE(test.start.omega.isZero(0.0));
  model::Mandel<double> stress;
  stress << -100e3, -65e3, -60e3, -5e3 * kSqrt2, 4e3 * kSqrt2, -3e3 * kSqrt2;
  EXPECT_LE((test.start.stress - stress).norm(), 1e-10);
  ASSERT_EQ(test.stages.size(), 1U);
  const Stage& stage = test.stages[0];
  EXPECT_EQ(stage.name, "mixed");
  EXPECT_EQ(stage.rows, 7);
  EXPECT_EQ(stage.first_row, 0.0);
  EXPECT_EQ(stage.increment.duration, 3e5);
  EXPECT_EQ(stage.increment.stress_controlled, (std::array{false, true, true, false, false, true}));
  EXPECT_TRUE(stage.increment.condition.isIdentity(0.0));
  EXPECT_DOUBLE_EQ(stage.increment.strain_rate[0], -1e-6);
  EXPECT_DOUBLE_EQ(stage.increment.strain_rate[3], -2e-6 * kSqrt2);
  EXPECT_DOUBLE_EQ(stage.increment.stress_rate[1], 500.0);
  EXPECT_DOUBLE_EQ(stage.target[2].value(), -80e3);
  EXPECT_DOUBLE_EQ(stage.target[4].value(), -0.01 * kSqrt2);
  EXPECT_DOUBLE_EQ(stage.target[5].value(), -4e3 * kSqrt2);
  EXPECT_FALSE(stage.target[0] || stage.target[1] || stage.target[3]);
  EXPECT_EQ(stage.increment.spin,
            Eigen::Vector3d(2e-6, 0.0, -1e-6));  // that of the motion: no sign to change
}

TEST_F(ElementFileTest, WhatIsNotNamedIsHeldAtZeroStrainRateForAHundredRows) {
  const ElementFile test = changed("name = \"mixed\"\nduration_s = 3e5\nrows = 7", "duration_s = 1");
  EXPECT_EQ(test.stages[0].name, "stage 1");
  EXPECT_EQ(test.stages[0].rows, 100);
  const ElementFile held = read(std::string(kElement) + "[[stage]]\nduration_s = 1\n");
  EXPECT_EQ(held.stages[1].name, "stage 2");
  EXPECT_TRUE(held.stages[1].increment.strain_rate.isZero(0.0));
  EXPECT_TRUE(held.stages[1].increment.strain_driven());
}

TEST_F(ElementFileTest, MeanStressTiesTheComponentsItNames) {
  const std::string all(replaced(std::string(kElement), "stress_rate_kPa_per_s = { 22 = -0.5 }\n",
                                 "mean_stress = { rate_kPa_per_s = 2, components = [\"33\", \"22\"] }\n"));
  const ElementFile test = read(replaced(all, "stress_kPa = { 33 = 80, 23 = 4 }\n", ""));
  const auto& increment = test.stages[0].increment;
  EXPECT_EQ(increment.stress_controlled, (std::array{false, true, true, false, false, false}));
  // 33, the first named, carries the mean; 22 goes as 33 does
  Eigen::Matrix<double, 6, 1> rates;
  rates << 1.0, 7.0, 4.0, 50.0, 60.0, 70.0;
  EXPECT_DOUBLE_EQ(increment.condition.row(2).dot(rates), 4.0);
  EXPECT_DOUBLE_EQ(increment.condition.row(1).dot(rates), 4.0 - 7.0);
  EXPECT_DOUBLE_EQ(increment.stress_rate[2], -2e3);
  EXPECT_DOUBLE_EQ(increment.stress_rate[1], 0.0);
}

TEST_F(ElementFileTest, AnOcrSetsTheVoidRatio) {
  // isotropic 100 kPa: p_B = OCR 100 kPa, so 1 + e = 2.5 OCR^-0.1; e at p_B = 200 kPa is CHECKS' 1.3325824788
  const ElementFile test =
      changed("[100, 65, 60, 5, -4, 3]\nvoid_ratio = 1.5", "[100, 100, 100, 0, 0, 0]\nocr = 2");
  EXPECT_NEAR(test.start.void_ratio, 1.3325824788, 1e-10);
}

TEST_F(ElementFileTest, OmegaHasTheSignOfTheCompressionPositiveDeviator) {
  const ElementFile test =
      changed("void_ratio = 1.5", "void_ratio = 1.5\nomega = [0.2, -0.1, -0.1, 0.05, 0, 0]");
  model::Mandel<double> omega;
  omega << -0.2, 0.1, 0.1, -0.05 * kSqrt2, 0.0, 0.0;
  EXPECT_LE((test.start.omega - omega).norm(), 1e-15);
  // the law's T*/p under the same compression has the same sign
  const model::Law<double> law(test.material);
  model::Mandel<double> compressed;
  compressed << -120e3, -90e3, -90e3, -5e3, 0.0, 0.0;
  EXPECT_GT(law.measures(compressed).ratio.dot(test.start.omega), 0.0);
}

TEST_F(ElementFileTest, RepeatedStagesAreWrittenOut) {
  const ElementFile test = read(std::string(kElement) + R"([[stage]]
name = "cycle"
repeat = 2
[[stage.stage]]
name = "up"
duration_s = 1
strain = { 11 = 0.002 }
[[stage.stage]]
duration_s = 3
first_row_s = 0.5
)");
  ASSERT_EQ(test.stages.size(), 5U);
  std::vector<std::string> names;
  for (const Stage& stage : test.stages) names.push_back(stage.name);
  EXPECT_EQ(names, (std::vector<std::string>{"mixed", "cycle 1: up", "cycle 1: stage 2", "cycle 2: up",
                                             "cycle 2: stage 2"}));
  EXPECT_EQ(test.stages[3].target[0].value(), -0.002);
  EXPECT_EQ(test.stages[4].first_row, 0.5);
}

TEST_F(ElementFileTest, MistakesOfTheStateAreNamed) {
  refused("void_ratio = 1.5", "",
          {"test.toml:9: key void_ratio in [state]: it is missing", "either void_ratio or ocr"});
  refused("void_ratio = 1.5", "void_ratio = 1.5\nocr = 2",
          {"test.toml:12: key ocr in [state]: given together"});
  refused("void_ratio = 1.5", "void_ratio = 0", {"test.toml:11: key void_ratio", "0 is out of range", "> 0"});
  refused("void_ratio = 1.5", "ocr = 0", {"test.toml:11: key ocr", "0 is out of range", "> 0 and <= 10000"});
  // 1 + e = 2.5 OCR^-0.1 is below 1 from OCR = 2.5^10 = 9537 on
  refused("[100, 65, 60, 5, -4, 3]\nvoid_ratio = 1.5", "[100, 100, 100, 0, 0, 0]\nocr = 9800",
          {"test.toml:11: key ocr", "9800 makes the void ratio -0.00"});
  refused("[100, 65, 60, 5, -4, 3]", "[100, 65, 60]",
          {"test.toml:10: key stress_kPa", "3 numbers", "six numbers"});
  refused("[100, 65, 60, 5, -4, 3]", "100",
          {"test.toml:10: key stress_kPa", "six numbers: 11, 22, 33, 12, 13, 23"});
  refused("[100, 65, 60, 5, -4, 3]", "[100, nan, 60, 0, 0, 0]",
          {"test.toml:10: key stress_kPa", "out of range"});
  refused("stress_kPa = [100, 65, 60, 5, -4, 3]", "", {"key stress_kPa in [state]: it is missing"});
  refused("[100, 65, 60, 5, -4, 3]", "[-10, -10, -10, 0, 0, 0]", {"mean stress p = -10", "p > 0"});
  refused("[100, 65, 60, 5, -4, 3]", "[100, 0, 0, 0, 0, 0]", {"q = 100 at p = 33.3333", "q < 3 p"});
  refused("void_ratio = 1.5", "void_ratio = 1.5\nomega = [0.1, 0, 0, 0, 0, 0]",
          {"test.toml:12: key omega in [state]: trace 0.1", "deviatoric"});
  refused("void_ratio = 1.5", "void_ratio = 1.5\nomega = [0.9, -0.45, -0.45, 0, 0, 0]",
          {"test.toml:12: key omega", "1.8225", "less than M^2"});
  refused("void_ratio = 1.5", "void_ratio = 1.5\nK0 = 1",
          {"test.toml:12: key K0 in [state]: it is unknown", "ocr"});
}

TEST_F(ElementFileTest, MistakesOfAStageAreNamed) {
  refused("duration_s = 3e5", "", {"key duration_s in [[stage]]: it is missing"});
  for (const char* bad : {"duration_s = 0", "duration_s = -1", "duration_s = inf", "duration_s = nan"}) {
    refused("duration_s = 3e5", bad,
            {"test.toml:14: key duration_s in [[stage]]", "out of range", "> 0 and <= "});
  }
  refused("rows = 7", "rows = 0", {"test.toml:15: key rows", "0 is out of range", ">= 1 and <= 100000"});
  refused("rows = 7", "rows = 2.5", {"test.toml:15: key rows", "2.5 is not a whole number"});
  refused("rows = 7", "rows = 7\nfirst_row_s = 3e5", {"test.toml:16: key first_row_s", "> 0 and < 300000"});
  refused("rows = 7", "rows = 1\nfirst_row_s = 10", {"test.toml:16: key first_row_s", "at least two rows"});
  refused("rows = 7", "row = 7", {"test.toml:15: key row in [[stage]]: it is unknown", "rows"});
  refused(
      "{ 11 = 1e-6, 12 = 2e-6 }", "{ 11 = 1e-6, 21 = 2e-6 }",
      {"test.toml:16: key 21 in [stage.strain_rate_per_s]: it is unknown; accepted: 11, 22, 33, 12, 13, 23"});
  refused("{ 11 = 1e-6, 12 = 2e-6 }", "{ 11 = \"fast\" }",
          {"test.toml:16: key 11 in [stage.strain_rate_per_s]: \"fast\" is not a number"});
  refused("{ 11 = 1e-6, 12 = 2e-6 }", "{ 11 = inf }",
          {"key 11 in [stage.strain_rate_per_s]", "a finite number"});
  refused("{ 11 = 1e-6, 12 = 2e-6 }", "1e-6", {"test.toml:16: key strain_rate_per_s", "accepted: a table"});
  refused("{ 22 = -0.5 }", "{ 11 = -0.5 }",
          {"test.toml:18: key 11 in [stage.stress_rate_kPa_per_s]: component 11 has its strain_rate_per_s "
           "already"});
  refused("{ 13 = 0.01 }", "{ 12 = 0.01 }", {"test.toml:17: key 12 in [stage.strain]", "component 12 has"});
  refused("{ 12 = 2e-6, 23 = -1e-6 }", "{ 11 = 1e-6 }",
          {"test.toml:20: key 11 in [stage.spin_per_s]: it is unknown; accepted: 12, 13, 23"});
  refused("[[stage]]", "[[stages]]", {"key stages: it is unknown"});
  EXPECT_NO_THROW(static_cast<void>(read(kElement)));
  const std::string_view content(kElement);
  expect_input_error([&] { static_cast<void>(read(content.substr(0, content.find("[[stage]]")))); },
                     {"test.toml:", "key stage: it is missing", "[[stage]]"});
}

TEST_F(ElementFileTest, MistakesOfMeanStressAndRepetitionAreNamed) {
  constexpr std::string_view kFrom = "strain = { 13 = 0.01 }";
  refused(kFrom, "mean_stress = { components = [\"22\"] }",
          {"test.toml:17: key rate_kPa_per_s", "either rate_kPa_per_s"});
  refused(kFrom, "mean_stress = { rate_kPa_per_s = 0, kPa = 1, components = [\"22\"] }",
          {"key kPa", "given together"});
  refused(kFrom, "mean_stress = { kPa = 100 }", {"key components in [stage.mean_stress]: it is missing"});
  refused(kFrom, "mean_stress = { kPa = 100, components = [] }", {"key components", "an empty list"});
  refused(kFrom, "mean_stress = { kPa = 100, components = [\"12\"] }", {"\"12\" is not one of them"});
  refused(kFrom, "mean_stress = { kPa = 100, components = [22] }", {"key components", "22; accepted"});
  refused(kFrom, "mean_stress = { kPa = 100, components = [\"22\"] }",
          {"component 22 has its stress_rate_kPa_per_s"});
  refused("name = \"mixed\"\n", "repeat = 2\n", {"key stage in [[stage]]: it is missing", "[[stage.stage]]"});
  const std::string cycle =
      std::string(kElement) + "[[stage]]\nrepeat = 30000\n[[stage.stage]]\nduration_s = 1\n";
  expect_input_error([&] { static_cast<void>(read(cycle)); },
                     {"test.toml:22: key repeat", "30000 times 1 stages", "at most 20000 stages"});
  expect_input_error(
      [&] { static_cast<void>(read(replaced(cycle, "repeat = 30000", "repeat = 2\nrows = 3"))); },
      {"test.toml:23: key rows in [[stage]]: it is unknown"});
  expect_input_error(
      [&] {
        static_cast<void>(read(replaced(cycle, "repeat = 30000\n[[stage.stage]]\n",
                                        "repeat = 2\n[[stage.stage]]\nrepeat = 2\n")));
      },
      {"key repeat in [[stage.stage]]: it is unknown"});
  expect_input_error(
      [&] {
        static_cast<void>(
            read(replaced(cycle, "30000\n[[stage.stage]]\n", "20000\n[[stage.stage]]\nrows = 100\n")));
      },
      {"2000007 rows in all", "at most 1000000 rows"});
}

TEST_F(ElementFileTest, EffectsAreRefused) {
  refused("[state]", "[effects]\ngas = { S_g = 0.1 }\n[state]", {"test.toml:9: table [effects]"});
}

TEST_F(ElementFileTest, TheExamplesOfTheDocumentationAreRead) {
  int read_files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(ISOTACH_SOURCE_DIR) / "docs/element")) {
    SCOPED_TRACE(entry.path());
    EXPECT_NO_THROW(static_cast<void>(read_element_file(entry.path())));
    ++read_files;
  }
  EXPECT_GE(read_files, 9);
}

}  // namespace
}  // namespace isotach::datasets
