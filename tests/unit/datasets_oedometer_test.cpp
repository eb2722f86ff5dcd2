// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// read_oedometer: columns, units, rows left out, and stages recorded or deduced.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "datasets/csv_table.hpp"
#include "datasets/oedometer.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

using namespace std::string_literals;

class OedometerTestFile : public testing::Test {
 protected:
  OedometerRecord read(std::string_view content, const Specimen& specimen = {0.02, 0.05}) const {
    return read_oedometer(folder_.write("crs.csv", content), specimen);
  }
  void expect_refused(std::string_view content, std::initializer_list<std::string_view> parts,
                      const Specimen& specimen = {0.02, 0.05}) const {
    expect_input_error([&] { static_cast<void>(read(content, specimen)); }, parts);
  }

  TemporaryFolder folder_;
};

TEST_F(OedometerTestFile, ComesOutInSI) {
  const auto record = read(
      "time_s,axial_strain,axial_stress_kPa,base_pore_pressure_kPa,temperature_C,stage\n"
      "0,0,4,0.5,20,load\n10,0.01,5,0.6,20.5,LOAD\n20,0.005,4.5,0.1,21,unload\n30,0.005,4.4,0,21,relax\n");
  ASSERT_EQ(record.rows.size(), 4U);
  EXPECT_EQ(record.rows[1].line, 3U);
  EXPECT_DOUBLE_EQ(record.rows[1].time, 10.0);
  EXPECT_DOUBLE_EQ(record.rows[1].axial_strain, 0.01);
  EXPECT_DOUBLE_EQ(record.rows[1].axial_stress, 5000.0);
  EXPECT_DOUBLE_EQ(record.rows[1].base_pore_pressure.value(), 600.0);
  EXPECT_DOUBLE_EQ(record.rows[1].temperature.value(), 20.5);
  EXPECT_EQ(record.rows[1].stage, Stage::load);
  EXPECT_EQ(record.rows[2].stage, Stage::unload);
  EXPECT_EQ(record.rows[3].stage, Stage::relax);
  EXPECT_FALSE(record.stages_deduced);
  EXPECT_TRUE(record.notes.empty());
  EXPECT_TRUE(record.unknown_columns.empty());
}

TEST_F(OedometerTestFile, StrainFollowsFromEveryColumnThatStatesIt) {
  // a specimen of 20 mm, compressed by 1 mm: strain 0.05 = 5 %, height 19 mm
  for (const std::string& form : {"axial_strain|0.05"s, "axial_strain_%|5"s, "axial_strain_pct|5"s,
                                  "height_mm|19"s, "displacement_mm|1"s, "settlement_mm|1"s}) {
    const std::string column = form.substr(0, form.find('|'));
    const std::string value = form.substr(form.find('|') + 1);
    std::string content = "time_s;" + column + ";axial_stress_kPa\n";
    for (const char* time : {"1", "2", "3"}) content += time + ";"s + value + ";10,5\n";
    const auto record = read(content);
    EXPECT_NEAR(record.rows[2].axial_strain, 0.05, 1e-15) << column;
    EXPECT_DOUBLE_EQ(record.rows[2].axial_stress, 10500.0) << column;
    EXPECT_FALSE(record.rows[2].base_pore_pressure.has_value());
  }
}

TEST_F(OedometerTestFile, StressFollowsFromForceAndDiameter) {
  // 1 kN on a circle of 50 mm: 4 kN/(pi 0.0025 m2)
  const double expected = 4000.0 / (std::numbers::pi * 0.0025);
  for (const char* column : {"axial_force_kN", "force_kN"}) {
    const std::string content = "time_s,axial_strain,"s + column + "\n0,0,1\n1,0.1,1\n2,0.2,1\n";
    EXPECT_NEAR(read(content).rows[0].axial_stress, expected, 1e-9 * expected);
    expect_refused(content, {"crs.csv", "column "s + column, "diameter"}, {0.02, std::nullopt});
  }
}

TEST_F(OedometerTestFile, RowsOutOfOrderOrWithoutStressAreDroppedAndNamed) {
  const auto record = read(
      "time_s,axial_strain,axial_stress_kPa,operator\n"
      "0,0.00,1,x\n"         // line 2
      "3300,0.01,2,x\n"      // line 3
      "3000,0.02,2,x\n"      // line 4: back
      "3300,0.02,2,x\n"      // line 5: again
      "3600,0.03,-0.26,x\n"  // line 6: no stress
      "3500,0.03,3,x\n"      // line 7: back, also behind the row that was dropped
      "3900,0.04,0,x\n"      // line 8: no stress
      "4200,0.05,4,x\n");    // line 9
  ASSERT_EQ(record.rows.size(), 3U);
  EXPECT_EQ(record.rows[2].line, 9U);
  ASSERT_EQ(record.notes.size(), 5U);
  EXPECT_EQ(record.notes[0].line, 4U);
  EXPECT_EQ(record.notes[0].what, "dropped: time 3000 s is not after 3300 s");
  EXPECT_EQ(record.notes[1].line, 5U);
  EXPECT_EQ(record.notes[1].what, "dropped: time 3300 s is not after 3300 s");
  EXPECT_EQ(record.notes[2].line, 6U);
  EXPECT_EQ(record.notes[2].what, "dropped: axial stress -0.26 kPa is not positive");
  EXPECT_EQ(record.notes[3].line, 7U);
  EXPECT_EQ(record.notes[3].what, "dropped: time 3500 s is not after 3600 s");
  EXPECT_EQ(record.notes[4].what, "dropped: axial stress 0 kPa is not positive");
  EXPECT_EQ(record.unknown_columns, std::vector<std::string>{"operator"});
}

TEST_F(OedometerTestFile, FewerThanThreeUsableRowsAreRefused) {
  expect_refused("time_s,axial_strain,axial_stress_kPa\n0,0,1\n1,0.1,2\n1,0.2,3\n",
                 {"crs.csv", "2 usable of 3", "line 4 dropped: time 1 s is not after 1 s", "at least 3"});
}

TEST_F(OedometerTestFile, MissingAndContradictoryColumnsAreRefused) {
  expect_refused("axial_strain,axial_stress_kPa\n0,1\n", {"crs.csv:1", "column time_s is missing"});
  expect_refused(
      "time_s,strain,axial_stress_kPa\n0,0,1\n",
      {"crs.csv:1", "axial_strain or", "height_mm", "columns found: time_s, strain, axial_stress_kPa"});
  expect_refused("time_s,axial_strain,stress\n0,0,1\n", {"crs.csv:1", "axial_stress_kPa or axial_force_kN"});
  expect_refused("time_s,axial_strain,height_mm,axial_stress_kPa\n0,0,20,1\n",
                 {"crs.csv", "axial_strain and height_mm state the same quantity"});
}

TEST_F(OedometerTestFile, ImpossibleReadingsAreRefused) {
  expect_refused("time_s,axial_strain,axial_stress_kPa\n0,5,1\n",
                 {"crs.csv:2: column axial_strain: \"5\" is out of range", "> -1 and < 1"});
  expect_refused("time_s,height_mm,axial_stress_kPa\n0,0,1\n",
                 {"crs.csv:2: column height_mm: \"0\"", "> 0 and < 40"});
  // within the column's range, but 1 - 1e-300/20 is 1 in double precision
  expect_refused("time_s,height_mm,axial_stress_kPa\n0,1e-300,1\n",
                 {"crs.csv:2: column height_mm: it means a strain of 1"});
  expect_refused("time_s,settlement_mm,axial_stress_kPa\n0,20,1\n", {"column settlement_mm: \"20\"", "< 20"});
  expect_refused("time_s,axial_strain,axial_stress_kPa\n0,0,abc\n",
                 {"crs.csv:2: column axial_stress_kPa: \"abc\""});
  expect_refused("time_s,axial_strain,axial_stress_kPa,stage\n0,0,1,creep\n",
                 {"crs.csv:2: column stage: \"creep\"", "load, unload, hold or relax"});
}

TEST_F(OedometerTestFile, AShortRecordThatOnlyMovesOneWayIsLoading) {
  const auto record = read("time_s,axial_strain,axial_stress_kPa\n0,0,1\n1,0.01,2\n2,0.02,3\n");
  EXPECT_TRUE(record.stages_deduced);
  for (const auto& row : record.rows) EXPECT_EQ(row.stage, Stage::load);
}

/// The bundled recorded stages are an independent answer to what is deduced without them.
TEST_F(OedometerTestFile, DeducedStagesAreTheRecordedOnes) {
  for (const char* name : {"mud-a/crs-1.csv", "mud-a/crs-2.csv", "mud-a/crs-3.csv", "mud-b/crs-1.csv",
                           "mud-b/crs-2.csv", "mud-b/crs-3.csv"}) {
    const auto recorded = read_oedometer(bundled(name), {0.02, 0.063});
    std::vector<double> times;
    std::vector<double> strains;
    for (const auto& row : recorded.rows) {
      times.push_back(row.time);
      strains.push_back(row.axial_strain);
    }
    const auto deduced = deduce_stages(times, strains);
    std::size_t different = 0;
    std::size_t changes = 0;
    std::size_t recorded_changes = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      // whether the strain or the stress is held cannot be seen in the strains
      const Stage expected = recorded.rows[i].stage == Stage::relax ? Stage::hold : recorded.rows[i].stage;
      if (deduced.stages[i] != expected) ++different;
      if (i == 0) continue;
      if (deduced.stages[i] != deduced.stages[i - 1]) ++changes;
      if (recorded.rows[i].stage != recorded.rows[i - 1].stage) ++recorded_changes;
    }
    EXPECT_EQ(changes, recorded_changes) << name;
    EXPECT_LE(different, 2 * recorded_changes) << name;  // up to two rows at each change
  }
}

TEST_F(OedometerTestFile, NoiseDoesNotTurnTheDirectionButAReversalDoes) {
  std::mt19937_64 generator(20240917);
  std::normal_distribution<double> noise(0.0, 2e-5);
  std::vector<double> times;
  std::vector<double> strains;
  // The noise is twice what a row moves: 2000 rows up to strain 0.02, 300 rows down, by 1e-5 each.
  for (int i = 0; i < 2300; ++i) {
    times.push_back(10.0 * i);
    strains.push_back(1e-5 * (i < 2000 ? i : 4000 - i) + noise(generator));
  }
  const auto deduced = deduce_stages(times, strains);
  for (std::size_t i = 0; i < 1980; ++i) ASSERT_EQ(deduced.stages[i], Stage::load) << i;
  for (std::size_t i = 2020; i < 2300; ++i) ASSERT_EQ(deduced.stages[i], Stage::unload) << i;
}

TEST_F(OedometerTestFile, ResolutionDoesNotTurnTheDirection) {
  std::vector<double> times;
  std::vector<double> strains;
  // readings of 5e-4 that flicker between neighbours while the specimen moves by 5e-5 a row
  for (int i = 0; i < 1000; ++i) {
    times.push_back(300.0 * i);
    const double flicker = i % 2 == 0 ? 0.3 : -0.3;
    strains.push_back(5e-4 * std::round(0.1 * i + flicker));
  }
  const auto deduced = deduce_stages(times, strains);
  for (std::size_t i = 0; i < 1000; ++i) ASSERT_EQ(deduced.stages[i], Stage::load) << i;
}

TEST_F(OedometerTestFile, AChangeToASlowRateIsNoHold) {
  std::vector<double> times;
  std::vector<double> strains;
  // 100 rows at 1e-5 1/s, 200 rows at 1e-7 1/s, a row each 1e-3 and 1e-4 of strain
  double time = 0.0;
  double strain = 0.0;
  for (int i = 0; i < 300; ++i) {
    times.push_back(time);
    strains.push_back(strain);
    time += i < 100 ? 100.0 : 1000.0;
    strain += i < 100 ? 1e-3 : 1e-4;
  }
  for (const Stage stage : deduce_stages(times, strains).stages) EXPECT_EQ(stage, Stage::load);
}

TEST_F(OedometerTestFile, AStrainThatStandsIsAHold) {
  const std::vector<double> times{0.0, 1.0, 2.0, 3.0, 4.0};
  const std::vector<double> strains(5, 0.1);
  for (const Stage stage : deduce_stages(times, strains).stages) EXPECT_EQ(stage, Stage::hold);
}

TEST(OedometerRealData, MiniSoilLabFileIsReadWithItsDefectsNamed) {
  const char* folder = std::getenv("ISOTACH_REALDATA");
  if (folder == nullptr) GTEST_SKIP() << "ISOTACH_REALDATA is not set";
  const auto file = std::filesystem::path(folder) / "minisoillab" / "Oedo-CRS-Visko_01.csv";
  const auto record = read_oedometer(file, {0.02, 0.07});
  EXPECT_EQ(record.rows.size() + record.notes.size(), 586U);
  // Its README: loaded to 228 kPa, unloaded to 12, reloaded to 1299.
  double peak = 0.0;
  std::vector<std::pair<Stage, double>> ends;  // of each stage, kPa
  for (const auto& row : record.rows) {
    if (ends.empty() || ends.back().first != row.stage) ends.emplace_back(row.stage, 0.0);
    ends.back().second = 1e-3 * row.axial_stress;
    peak = std::max(peak, ends.back().second);
  }
  EXPECT_NEAR(peak, 1299.5, 1.0);
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_EQ(ends[0].first, Stage::load);
  EXPECT_NEAR(ends[0].second, 228.0, 3.0);
  EXPECT_EQ(ends[1].first, Stage::unload);
  EXPECT_NEAR(ends[1].second, 12.0, 2.0);
  EXPECT_EQ(ends[2].first, Stage::load);
  // the clock steps back from 78421 s to 78300 s
  const bool named = std::any_of(record.notes.begin(), record.notes.end(), [](const RowNote& note) {
    return note.line == 265 && note.what == "dropped: time 78300 s is not after 78421 s";
  });
  EXPECT_TRUE(named);
}

}  // namespace
}  // namespace isotach::datasets
