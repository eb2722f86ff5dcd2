// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Oedometer tests in the columns of the Dutch subsurface registry, alone and in a study.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "datasets/bro.hpp"
#include "tests/unit/datasets_files.hpp"
#include "tests/unit/datasets_small_study.hpp"

namespace isotach::datasets {
namespace {

constexpr std::string_view kHeader =
    "bro_id,begin_depth_m,end_depth_m,water_content_pct,bulk_density_g_cm3,step,step_type,"
    "vertical_stress_kPa,strain_24h_pct,time_s,strain_pct\n";
constexpr std::string_view kRows =
    "B1,2.5,2.6,80,1.5,1,ontlastingstap,10,1,0,0\n"
    "B1,2.5,2.6,80,1.5,1,ontlastingstap,10,1,60,0.5\n"
    "B1,2.5,2.6,80,1.5,1,ontlastingstap,10,1,86400,1\n"
    "B1,2.5,2.6,80,1.5,2,belastingstap,20,3,0,0\n"
    "B1,2.5,2.6,80,1.5,2,belastingstap,20,3,60,2\n"
    "B1,2.5,2.6,80,1.5,3,relaxatiestap,20,3,100,2\n"
    "B1,2.5,2.6,80,1.5,4,ontlastingstap,10,2.5,60,1.8\n";
constexpr std::string_view kOther =
    "B2,1,1.1,50,1.7,1,belastingstap,5,1,10,0.1\n"
    "B2,1,1.1,50,1.7,1,belastingstap,5,1,20,0.2\n"
    "B2,1,1.1,50,1.7,1,belastingstap,5,1,30,0.3\n";

std::string both() {
  return std::string(kHeader) + std::string(kRows) + std::string(kOther);
}

TEST(Bro, TimesAccumulateAndStepsFollowTheirLoads) {
  const CsvTable table = CsvTable::parse(both(), "bro.csv");
  ASSERT_TRUE(is_bro(table));
  const auto tests = find_bro_tests(table);
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_DOUBLE_EQ(tests[0].specimen.water_content.value(), 0.8);
  EXPECT_DOUBLE_EQ(tests[0].specimen.bulk_density.value(), 1500.0);
  const auto record = parse_bro(table, tests[0]);
  ASSERT_EQ(record.steps.size(), 3U);
  EXPECT_EQ(record.steps[0].stage, Stage::load);  // typed unload, yet the first and the strain grows
  EXPECT_EQ(record.steps[1].begin, 86400.0);
  EXPECT_EQ(record.rows[2].time, 86460.0);
  EXPECT_DOUBLE_EQ(record.rows[2].axial_strain, 0.02);
  EXPECT_EQ(record.steps[2].begin, 86560.0);  // behind the relaxation of 100 s
  EXPECT_EQ(record.steps[2].stage, Stage::unload);
  EXPECT_EQ(record.rows.size(), 4U);
  ASSERT_EQ(record.notes.size(), 3U);
  EXPECT_NE(record.notes[0].what.find("recorded as unload but read as load"), std::string::npos);
  EXPECT_NE(record.notes[1].what.find("step 3 left out: a relaxation"), std::string::npos);
  EXPECT_NE(record.notes[2].what.find("2 readings at the very moment of loading"), std::string::npos);
}

TEST(Bro, ALoadThatChangesWithinAStepAndAnUnknownTypeAreRefused) {
  const auto refused = [](std::string_view from, std::string_view to,
                          std::initializer_list<std::string_view> parts) {
    const CsvTable table = CsvTable::parse(replaced(both(), from, to), "bro.csv");
    expect_input_error([&] { static_cast<void>(parse_bro(table, find_bro_tests(table)[0])); }, parts);
  };
  refused("10,1,60,0.5", "11,1,60,0.5", {"bro.csv:3", "vertical_stress_kPa", "11 in step 1", "with 10"});
  refused("2,belastingstap", "2,loading", {"bro.csv:5", "\"loading\"", "ontlastingstap"});
  refused("60,0.5", "60,x", {"bro.csv:3: column strain_pct: \"x\" is not a number"});
}

class BroStudy : public SmallStudy {};

TEST_F(BroStudy, ASelectedTestIsReadWithItsFilesWaterContentAndDensity) {
  folder_.write("bro.csv", both());
  const Study study = read_test("data = \"bro.csv\"\nselect = { bro_id = \"B1\", begin_depth_m = 2.50 }\n");
  const OedometerTest& test = study.oedometer_tests[0];
  EXPECT_EQ(test.record.control, Control::stress);
  EXPECT_DOUBLE_EQ(test.height, 0.02);
  // (1 + 0.8) 2.65/1.5 - 1 = 2.18; S_r = 0.8 2.65/2.18 = 0.9725
  EXPECT_NEAR(test.void_ratio, 2.18, 1e-12);
  EXPECT_NEAR(test.void_ratio_per_specific_gravity.value(), 1.2, 1e-12);
  EXPECT_NE(test.void_ratio_source.find("degree of saturation 0.972"), std::string::npos);
  EXPECT_TRUE(assumes(study, "specific gravity not given, 2.65 assumed"));
  EXPECT_TRUE(assumes(study, "20 mm assumed where a length is needed"));
  EXPECT_EQ(test.end_of_primary.rule, EndOfPrimary::Rule::taylor);
}

TEST_F(BroStudy, AnAmbiguousSelectionListsTheTests) {
  folder_.write("bro.csv", both());
  expect_test_refused("data = \"bro.csv\"\n",
                      {"study.toml:9", "2 tests and none is selected",
                       "{ bro_id = \"B1\", begin_depth_m = 2.5 }, { bro_id = \"B2\", begin_depth_m = 1 }"});
  expect_test_refused("data = \"bro.csv\"\nselect = { bro_id = \"B3\" }\n",
                      {"{ bro_id = \"B3\" } fits no test", "\"B2\""});
  expect_test_refused("data = \"bro.csv\"\nselect = { LOCA_ID = \"B1\" }\n",
                      {"key select", "LOCA_ID", "BRO", "bro_id, begin_depth_m"});
  expect_test_refused("data = \"bro.csv\"\nselect = { bro = \"B1\" }\n", {"key bro in [oedometer.select]"});
  expect_test_refused("data = \"bro.csv\"\nselect = { bro_id = \"B1\" }\nprotocol = \"strain\"\n",
                      {"key protocol", "BRO", "\"stress\""});
}

/// The first and last steps of the four tests as the data's own columns have them.
TEST_F(BroStudy, TheRegistrysTestsAreReadWithoutHandHolding) {
  const char* folder = std::getenv("ISOTACH_REALDATA");
  if (folder == nullptr) GTEST_SKIP() << "ISOTACH_REALDATA is not set";
  const auto file = std::filesystem::path(folder) / "bro" / "bro_oedometer_il.csv";
  struct Expected {
    std::string select;
    std::size_t steps;
    double last_load_kPa;
    double last_strain;
    double e0;  // from the columns: (1 + w) G_s/rho - 1
  };
  for (const Expected& expected :
       {Expected{"bro_id = \"BHR000000377186\"", 5, 80.0, 0.1755, 1.504 * 2.65 / 1.520 - 1.0},
        Expected{"bro_id = \"BHR000000380390\", begin_depth_m = 3.81", 7, 320.0, 0.3418,
                 1.848 * 2.65 / 1.453 - 1.0},
        Expected{"bro_id = \"BHR000000380390\", begin_depth_m = 7.42", 7, 480.0, 0.5328,
                 4.289 * 1.5 / 1.073 - 1.0},
        Expected{"bro_id = \"BHR000000380415\"", 7, 360.0, 0.2205, 1.488 * 2.65 / 1.696 - 1.0}}) {
    const bool peat = expected.last_load_kPa == 480.0;
    const std::string keys = "data = \"" + file.string() + "\"\nselect = { " + expected.select + " }\n";
    if (peat) expect_test_refused(keys, {"specific_gravity", "3.289", "organic", "soil"});
    const Study study = read_test(keys + (peat ? "soil = \"peat\"\n" : ""));
    const OedometerTest& test = study.oedometer_tests[0];
    ASSERT_EQ(test.record.steps.size(), expected.steps) << expected.select;
    EXPECT_NEAR(test.record.steps.back().load, 1e3 * expected.last_load_kPa, 1e-6);
    EXPECT_NEAR(test.record.rows.back().axial_strain, expected.last_strain, 1e-12);
    EXPECT_NEAR(test.void_ratio, expected.e0, 1e-9) << test.void_ratio_source;
    // The first test alone has a degree of saturation (0.504 2.65/1.622 = 0.823) that is out of the ordinary.
    EXPECT_EQ(assumes(study, "degree of saturation of 0.823"), expected.steps == 5);
    const auto& notes = test.record.notes;
    const bool remarked = std::any_of(notes.begin(), notes.end(), [](const RowNote& note) {
      return note.what.find("step 1 is recorded as unload but read as load") != std::string::npos;
    });
    EXPECT_EQ(remarked, peat);
    EXPECT_EQ(test.record.steps.front().stage, Stage::load);
  }
}

}  // namespace
}  // namespace isotach::datasets
