// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// effective_stress and the check of pore pressure ratios, and both in a record.
#include <gtest/gtest.h>

#include <vector>

#include "datasets/effective_stress.hpp"
#include "datasets/oedometer.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

using enum PorePressureFormula;

TEST(EffectiveStress, FollowsTheTwoFormulas) {
  // By hand: 300 - (2/3) 60 = 260; 300 (300 - 60)^2 = 1.728e7, whose cube root is 258.532...
  // (258.5^3 = 17273700.6, 258.54^3 = 17281720.5)
  EXPECT_DOUBLE_EQ(effective_stress(300e3, 60e3, linear).value(), 260e3);
  const double nonlinear_stress = effective_stress(300e3, 60e3, nonlinear).value();
  EXPECT_GT(nonlinear_stress, 258.50e3);
  EXPECT_LT(nonlinear_stress, 258.54e3);
  // sigma = 2 u: the cube root of 2
  EXPECT_NEAR(effective_stress(2.0, 1.0, nonlinear).value(), 1.259921049894873, 1e-14);
}

TEST(EffectiveStress, BothFormulasAgreeToFirstOrderInASmallPorePressure) {
  // the nonlinear one expanded: sigma (1 - 2 r/3 - r^2/9 - ...), r = u_b/sigma
  const double r = 1e-3;
  const double difference =
      effective_stress(1.0, r, linear).value() - effective_stress(1.0, r, nonlinear).value();
  EXPECT_NEAR(difference, r * r / 9.0, 1e-2 * r * r / 9.0);
  EXPECT_DOUBLE_EQ(effective_stress(5e3, 0.0, nonlinear).value(), 5e3);
}

TEST(EffectiveStress, IsNothingWhereItWouldNotBePositive) {
  EXPECT_FALSE(effective_stress(10.0, 15.0, linear).has_value());
  EXPECT_TRUE(effective_stress(10.0, 14.9, linear).has_value());
  EXPECT_FALSE(effective_stress(10.0, 10.0, nonlinear).has_value());
  EXPECT_FALSE(effective_stress(10.0, 25.0, nonlinear).has_value());  // its cubic would be positive again
  EXPECT_FALSE(effective_stress(-1.0, -2.0, nonlinear).has_value());
}

TEST(PorePressureCheck, CountsRatiosOutsideOfTheBand) {
  const std::vector<double> total{100.0, 100.0, 100.0, 100.0, 100.0};
  const std::vector<double> base{2.0, 3.0, 10.0, 15.0, 20.0};
  const auto check = check_pore_pressures(total, base, linear);
  EXPECT_EQ(check.loading_rows, 5U);
  EXPECT_EQ(check.outside, 2U);
  EXPECT_DOUBLE_EQ(check.least_ratio, 0.02);
  EXPECT_DOUBLE_EQ(check.greatest_ratio, 0.20);
}

class PorePressureFile : public testing::Test {
 protected:
  OedometerRecord read(std::string_view content, const OedometerReading& reading) const {
    return read_oedometer(folder_.write("crs.csv", content), {0.02, std::nullopt}, reading);
  }
  static constexpr std::string_view kFile =
      "time_s,axial_strain,axial_stress_kPa,base_pore_pressure_kPa,stage\n"
      "0,0,100,3,load\n1,0.01,200,60,load\n2,0.02,10,40,load\n3,0.03,300,30,load\n4,0.02,100,-30,unload\n";

  TemporaryFolder folder_;
};

TEST_F(PorePressureFile, TotalStressesAreReducedAndKept) {
  const auto record = read(kFile, {Control::strain, linear});
  ASSERT_EQ(record.rows.size(), 4U);
  EXPECT_DOUBLE_EQ(record.rows[0].axial_stress, 98e3);
  EXPECT_DOUBLE_EQ(record.rows[0].total_stress.value(), 100e3);
  EXPECT_DOUBLE_EQ(record.rows[1].axial_stress, 160e3);
  EXPECT_DOUBLE_EQ(record.rows[3].axial_stress, 120e3);  // suction while unloaded
  ASSERT_EQ(record.notes.size(), 1U);
  EXPECT_EQ(record.notes[0].line, 4U);
  EXPECT_NE(record.notes[0].what.find("10 kPa the base pore pressure 40 kPa leaves no positive"),
            std::string::npos);
  ASSERT_TRUE(record.pore_pressure.has_value());
  EXPECT_EQ(record.pore_pressure->reduced_by, linear);
  EXPECT_EQ(record.pore_pressure->loading_rows, 3U);  // ratios 0.03, 0.3, 0.1
  EXPECT_EQ(record.pore_pressure->outside, 1U);
  EXPECT_DOUBLE_EQ(record.pore_pressure->least_ratio, 0.03);
  EXPECT_DOUBLE_EQ(record.pore_pressure->greatest_ratio, 0.3);
}

TEST_F(PorePressureFile, EffectiveStressesAreOnlyChecked) {
  const auto record = read(kFile, {});
  ASSERT_EQ(record.rows.size(), 5U);
  EXPECT_DOUBLE_EQ(record.rows[1].axial_stress, 200e3);
  EXPECT_FALSE(record.rows[1].total_stress.has_value());
  ASSERT_TRUE(record.pore_pressure.has_value());
  EXPECT_FALSE(record.pore_pressure->reduced_by.has_value());
  // sigma = sigma' + (2/3) u_b: 3/102 is the least, 40/(10 + 80/3) the greatest
  EXPECT_DOUBLE_EQ(record.pore_pressure->least_ratio, 3.0 / 102.0);
  EXPECT_DOUBLE_EQ(record.pore_pressure->greatest_ratio, 12.0 / 11.0);
}

TEST_F(PorePressureFile, AForceIsReducedLikewise) {
  const auto file = folder_.write("force.csv",
                                  "time_s,axial_strain,force_kN,base_pore_pressure_kPa\n"
                                  "0,0,1,3\n1,0.01,2,3\n2,0.02,3,3\n");
  // 1000/pi mm in diameter: pi/4 d^2 = 0.25/pi m2, so that 1 kN is 4 pi kPa
  const double diameter = 1.0 / 3.141592653589793;
  const auto total = read_oedometer(file, {0.02, diameter}, {Control::strain, linear});
  EXPECT_TRUE(total.stress_from_force);
  EXPECT_NEAR(total.rows.back().total_stress.value(), 12e3 * 3.141592653589793, 1e-8);
  EXPECT_NEAR(total.rows.back().axial_stress, 1e3 * (12.0 * 3.141592653589793 - 2.0), 1e-8);
}

}  // namespace
}  // namespace isotach::datasets
