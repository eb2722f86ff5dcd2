// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The bundled studies and slump files: all of them are read, and hold what their sources state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "datasets/slump_file.hpp"
#include "datasets/study.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

struct MudFacts {
  const char* folder;
  double friction_angle_deg;
  double oedometer_void_ratio;
  double stiff_void_ratio;
  double soft_void_ratio;
};

class BundledStudy : public testing::TestWithParam<MudFacts> {};

TEST_P(BundledStudy, HoldsWhatTheVirtualLaboratoryStates) {
  const MudFacts& mud = GetParam();
  const Study study = read_study(bundled(mud.folder) / "study.toml");
  EXPECT_TRUE(study.assumptions.empty());
  EXPECT_DOUBLE_EQ(study.material.phi_c(), mud.friction_angle_deg * std::numbers::pi / 180.0);
  using enum model::ParameterId;
  // the CRS tests change rate and direction: they hold I_v and C_1 as well
  EXPECT_EQ(study.fit.oedometer, (std::vector<model::ParameterId>{e100, lambda, kappa, D_r, I_v, C_1}));
  EXPECT_EQ(study.fit.gauge, Gauge::crs_rate);
  EXPECT_FALSE(study.fit.reference_rate.has_value());

  std::set<std::string> held_out;
  ASSERT_EQ(study.oedometer_tests.size(), 3U);
  constexpr std::size_t kRows[] = {410, 190, 250};  // lines of the files less the header
  for (std::size_t i = 0; i < 3; ++i) {
    const OedometerTest& test = study.oedometer_tests[i];
    EXPECT_EQ(test.record.rows.size(), kRows[i]);
    EXPECT_TRUE(test.record.notes.empty());
    EXPECT_FALSE(test.record.stages_deduced);
    EXPECT_DOUBLE_EQ(test.height, i == 1 ? 0.03 : 0.02);
    EXPECT_DOUBLE_EQ(test.void_ratio, mud.oedometer_void_ratio);
    EXPECT_DOUBLE_EQ(test.initial_K0, 0.8);
    EXPECT_DOUBLE_EQ(test.initial_axial_stress.value(), 4000.0);
    if (test.hold_out) held_out.insert(test.name);
  }

  ASSERT_EQ(study.slump_tests.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    const SlumpTest& test = study.slump_tests[i];
    EXPECT_EQ(test.name, "slump-" + std::to_string(i + 1));
    const bool fast = i % 4 < 2;
    EXPECT_DOUBLE_EQ(test.setup.mould.lift_speed, fast ? 0.06 : 0.01);
    EXPECT_DOUBLE_EQ(test.setup.mould.fill_height, i % 2 == 0 ? 0.14 : 0.07);
    EXPECT_TRUE(test.setup.mould.wall.is_smooth());
    EXPECT_DOUBLE_EQ(test.setup.mud.void_ratio.value(), i < 4 ? mud.stiff_void_ratio : mud.soft_void_ratio);
    EXPECT_DOUBLE_EQ(test.setup.numerics.water_bulk_modulus, 3e5);
    EXPECT_EQ(test.setup.times, fast ? (std::vector{0.5, 1.0, 2.0, 5.0, 15.0, 30.0})
                                     : (std::vector{2.0, 4.0, 6.0, 10.0, 16.0, 30.0}));
    // No mould is emptied to more than it held, and none is left full.
    EXPECT_LT(test.outlines.back().points.back().z, test.setup.mould.fill_height);
    EXPECT_GT(test.outlines.back().points.front().r, 0.5 * test.setup.mould.diameter);
    if (test.hold_out) held_out.insert(test.name);
  }
  EXPECT_EQ(held_out, (std::set<std::string>{"crs-3", "slump-4", "slump-5", "slump-7"}));
}

INSTANTIATE_TEST_SUITE_P(Muds, BundledStudy,
                         testing::Values(MudFacts{"mud-a", 15.3, 2.7615, 3.89, 4.251},
                                         MudFacts{"mud-b", 16.8, 2.7430, 4.075, 4.488}),
                         [](const auto& parameter) { return std::string(1, parameter.param.folder[4]); });

/// The first data row of a file, by hand: 2142.9 s, 0.001489, 4.5971 kPa.
TEST(BundledData, FirstReadingOfMudA) {
  const Study study = read_study(bundled("mud-a/study.toml"));
  const OedometerRow& row = study.oedometer_tests[0].record.rows.front();
  EXPECT_DOUBLE_EQ(row.time, 2142.9);
  EXPECT_DOUBLE_EQ(row.axial_strain, 0.001489);
  EXPECT_DOUBLE_EQ(row.axial_stress, 4597.1);
  EXPECT_EQ(row.stage, Stage::load);
  EXPECT_DOUBLE_EQ(study.slump_tests[0].outlines[0].points[0].r, 0.087757);
  EXPECT_DOUBLE_EQ(study.slump_tests[0].outlines[0].points[0].z, 0.002);
}

TEST(BundledData, EverySlumpFileIsReadAndUsesTheSeedsMaterial) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(bundled("pippi2019"))) {
    if (entry.path().extension() != ".toml") continue;
    const SlumpFile slump = read_slump_file(entry.path());
    ++count;
    EXPECT_DOUBLE_EQ(slump.material.e100(), 1.358);
    EXPECT_DOUBLE_EQ(slump.material.lambda(), 0.154);
    EXPECT_DOUBLE_EQ(slump.material.kappa(), 0.0129);
    EXPECT_DOUBLE_EQ(slump.material.D_r(), 6.8e-7);
    EXPECT_DOUBLE_EQ(slump.material.phi_c(), 14.2 * std::numbers::pi / 180.0);
    EXPECT_DOUBLE_EQ(slump.setup.mould.diameter, 0.078);
    EXPECT_TRUE(slump.setup.mould.wall.is_smooth());
    EXPECT_DOUBLE_EQ(slump.setup.numerics.cell_size, 0.008);
    EXPECT_EQ(slump.setup.numerics.points_per_cell, 4);
    EXPECT_DOUBLE_EQ(slump.setup.times.back(), 30.0);
    ASSERT_EQ(slump.assumptions.size(), 1U);
    EXPECT_NE(slump.assumptions[0].find("|D| = D_r"), std::string::npos);
  }
  EXPECT_EQ(count, 16U);  // 8 tests, 3 of I_v, 3 of C_1, 2 final
}

TEST(BundledData, Table1) {
  for (int test = 1; test <= 8; ++test) {
    const SlumpFile slump = read_slump_file(bundled("pippi2019/test-" + std::to_string(test) + ".toml"));
    EXPECT_DOUBLE_EQ(slump.setup.mud.undrained_strength.value(), test <= 4 ? 117.0 : 72.0);
    EXPECT_DOUBLE_EQ(slump.setup.mould.fill_height, test % 2 == 1 ? 0.14 : 0.07);
    EXPECT_DOUBLE_EQ(slump.setup.mould.lift_speed, (test - 1) % 4 < 2 ? 0.06 : 0.01);
    EXPECT_DOUBLE_EQ(slump.material.I_v(), 0.02);
    EXPECT_DOUBLE_EQ(slump.material.C_1(), 0.03);
    // where fast and slow lifts are compared
    for (const double time : {2.0, 5.0, 15.0, 30.0}) {
      EXPECT_EQ(std::count(slump.setup.times.begin(), slump.setup.times.end(), time), 1) << test;
    }
  }
}

TEST(BundledData, FinalSetAtTheTimeOfFigure9) {
  for (const auto& [test, lift_speed] : {std::pair{"1", 0.06}, std::pair{"3", 0.01}}) {
    const SlumpFile slump = read_slump_file(bundled("pippi2019/final-test-" + std::string(test) + ".toml"));
    EXPECT_DOUBLE_EQ(slump.material.I_v(), 0.02);
    EXPECT_DOUBLE_EQ(slump.material.C_1(), 0.03);
    EXPECT_DOUBLE_EQ(slump.setup.mould.fill_height, 0.14);
    EXPECT_DOUBLE_EQ(slump.setup.mould.lift_speed, lift_speed);
    EXPECT_EQ(slump.setup.times, (std::vector{30.0}));
  }
}

/// The page's own files are the seed's, but for what they are there to change.
TEST(BundledData, ShortColumnsOfTheSeedProgrammeAreThoseOfFigure7) {
  for (const std::string I_v : {"0.03", "0.05", "0.06"}) {
    const SlumpFile own = read_slump_file(std::filesystem::path(ISOTACH_SOURCE_DIR) /
                                          ("docs/seed-programme/short-iv-" + I_v + ".toml"));
    const SlumpFile paper = read_slump_file(bundled("pippi2019/iv-" + I_v + ".toml"));
    EXPECT_EQ(own.material.values().values, paper.material.values().values);
    EXPECT_EQ(own.setup.mud.undrained_strength, paper.setup.mud.undrained_strength);
    EXPECT_EQ(own.setup.mud.strength_rate, 1e-3);
    EXPECT_EQ(own.setup.mould.fill_height, 0.07);
    EXPECT_EQ(own.setup.mould.lift_speed, paper.setup.mould.lift_speed);
    EXPECT_EQ(own.setup.mud.overconsolidation_ratio, paper.setup.mud.overconsolidation_ratio);
    EXPECT_EQ(own.setup.numerics.cell_size, paper.setup.numerics.cell_size);
  }
}

TEST(BundledData, SensitivitySeries) {
  for (const char* I_v : {"0.03", "0.05", "0.06"}) {
    const SlumpFile slump = read_slump_file(bundled("pippi2019/iv-" + std::string(I_v) + ".toml"));
    EXPECT_DOUBLE_EQ(slump.material.I_v(), std::stod(I_v));
    EXPECT_DOUBLE_EQ(slump.material.C_1(), 0.1);
    EXPECT_EQ(slump.setup.times, (std::vector{5.2, 15.2, 30.0}));
  }
  for (const char* C_1 : {"0.025", "0.05", "0.1"}) {
    const SlumpFile slump = read_slump_file(bundled("pippi2019/c1-" + std::string(C_1) + ".toml"));
    EXPECT_DOUBLE_EQ(slump.material.C_1(), std::stod(C_1));
    EXPECT_DOUBLE_EQ(slump.material.I_v(), 0.03);
    EXPECT_EQ(slump.setup.times, (std::vector{4.05, 13.3, 30.0}));
  }
}

TEST(BundledData, TheCheckedSlumpHasTheDensityOfThePrototype) {
  const SlumpFile slump = read_slump_file(bundled("checks/slump-test-1.toml"));
  const double e0 = slump.setup.mud.void_ratio.value();
  EXPECT_DOUBLE_EQ(e0, 3.891);
  EXPECT_NEAR(1000.0 * (slump.setup.mud.specific_gravity + e0) / (1.0 + e0), 1337.0, 0.5);
  EXPECT_DOUBLE_EQ(slump.setup.mud.overconsolidation_ratio, 1.5);
  EXPECT_DOUBLE_EQ(slump.setup.numerics.cell_size, 0.004);
  EXPECT_DOUBLE_EQ(slump.setup.numerics.water_bulk_modulus, 3e5);
  EXPECT_EQ(slump.setup.times, (std::vector{0.5, 1.0, 5.0, 15.0, 30.0}));
  EXPECT_TRUE(slump.assumptions.empty());
}

}  // namespace
}  // namespace isotach::datasets
