// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the curves written as CSV.
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/csv_table.hpp"
#include "datasets/outline.hpp"
#include "reports/curves_csv.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

using datasets::CsvTable;

class CurvesCsv : public ResultFolder {};

double cell(const CsvTable& table, std::size_t row, std::string_view column) {
  return table.number(row, table.require(column));
}

TEST_F(CurvesCsv, OedometerCurvesAlignWithTheData) {
  OutputDirectory output(root_ / "out");
  write_curves(output, small_calibration().oedometer);
  output.commit();
  const CsvTable table = CsvTable::read(root_ / "out/curves/oedometer/crs-2.csv");
  ASSERT_EQ(table.row_count(), 190U);
  // the first row of crs-2.csv: 666.7 s, strain 0.002335, 4.8352 kPa; e = 3.7615 (1 - 0.002335) - 1
  EXPECT_EQ(cell(table, 0, "time_s"), 666.7);
  EXPECT_NEAR(cell(table, 0, "measured_stress_kPa"), 4.8352, 1e-12);
  EXPECT_NEAR(cell(table, 0, "void_ratio"), 2.752717, 1e-6);
  EXPECT_EQ(table.text(0, table.require("stage")), "load");
  // residual = ln(fitted/measured)/noise; noise^2 = 0.005^2 + (0.02/4.8352)^2 + (2e-5 slope)^2, the last
  // small
  const double misfit = std::log(cell(table, 0, "fitted_stress_kPa") / cell(table, 0, "measured_stress_kPa"));
  EXPECT_NEAR(misfit / cell(table, 0, "residual_in_noise"), std::hypot(0.005, 0.02 / 4.8352), 2e-5);
  const CsvTable search = CsvTable::read(root_ / "out/curves/oedometer_convergence.csv");
  EXPECT_LT(cell(search, search.row_count() - 1, "cost"), cell(search, 0, "cost"));
  EXPECT_TRUE(search.find("kappa"));
}

TEST_F(CurvesCsv, EveryDrawnOedometerCurveIsWritten) {
  OutputDirectory output(root_ / "out");
  write_curves(output, assessed_fit());
  output.commit();
  const CsvTable isotachs = CsvTable::read(root_ / "out/curves/oedometer_isotachs/crs-2.csv");
  // an isotach is a straight line of slope -lambda in ln(1+e) against ln stress
  const double slope =
      std::log((1.0 + cell(isotachs, 1, "void_ratio")) / (1.0 + cell(isotachs, 0, "void_ratio"))) /
      std::log(cell(isotachs, 1, "axial_stress_kPa") / cell(isotachs, 0, "axial_stress_kPa"));
  EXPECT_NEAR(slope, -assessed_fit().result.parameters->lambda(), 1e-9);
  const CsvTable profiles = CsvTable::read(root_ / "out/curves/oedometer_profiles.csv");
  EXPECT_EQ(profiles.text(0, profiles.require("parameter")), "e100");
  const CsvTable starts = CsvTable::read(root_ / "out/curves/oedometer_starts.csv");
  EXPECT_EQ(starts.text(0, starts.require("kind")), "start");
  EXPECT_TRUE(std::filesystem::exists(root_ / "out/curves/oedometer_constructions/crs-2.csv"));
  EXPECT_TRUE(std::filesystem::exists(root_ / "out/curves/oedometer_isotachs/crs-3.csv"));
  EXPECT_FALSE(std::filesystem::exists(root_ / "out/curves/oedometer_constructions/crs-3.csv"));
}

TEST_F(CurvesCsv, SlumpOutlinesAreReadableAsData) {
  OutputDirectory output(root_ / "out");
  const calibration::SlumpFit& fit = small_calibration().slump;
  write_curves(output, fit);
  output.commit();
  const auto outlines = datasets::read_outlines(root_ / "out/curves/slump/slump-2_outlines.csv");
  ASSERT_EQ(outlines.size(), 2U);
  EXPECT_NEAR(outlines[0].time, 0.5, 1e-9);
  EXPECT_NEAR(outlines[1].points.front().r, fit.comparisons[0].simulation.outlines[1].points.front().r,
              1e-12);
  const CsvTable distances = CsvTable::read(root_ / "out/curves/slump/slump-2_distances.csv");
  EXPECT_EQ(distances.row_count(), small_study().slump_tests[0].outlines[0].points.size() +
                                       small_study().slump_tests[0].outlines[1].points.size());
  // a rim at 0.06 m/s is 30 mm up after 0.5 s and the noise then 2.5 mm
  EXPECT_EQ(cell(distances, 0, "mould_gone"), 0.0);
  EXPECT_NEAR(cell(distances, 0, "distance_mm"), 2.5 * cell(distances, 0, "distance_in_noise"), 1e-9);
}

TEST_F(CurvesCsv, NamesOfTestsCannotLeaveTheFolderNorHideEachOther) {
  calibration::SlumpFit fit = small_calibration().slump;
  const char* names[] = {"../a b", "../a/b"};
  for (std::size_t i = 0; i < 2; ++i) {
    datasets::SlumpTest test = fit.comparisons[i].experiment->test();
    test.name = names[i];
    fit.comparisons[i].experiment = std::make_shared<experiments::SlumpExperiment>(test);
  }
  OutputDirectory output(root_ / "out");
  write_curves(output, fit);
  output.commit();
  EXPECT_TRUE(std::filesystem::exists(root_ / "out/curves/slump/.._a_b_outlines.csv"));
  EXPECT_TRUE(std::filesystem::exists(root_ / "out/curves/slump/.._a_b_2_outlines.csv"));
}

TEST_F(CurvesCsv, HistoryOfOneSlump) {
  OutputDirectory output(root_ / "out");
  write_curves(output, short_slump());
  output.commit();
  const CsvTable history = CsvTable::read(root_ / "out/history.csv");
  EXPECT_EQ(history.columns(),
            (std::vector<std::string>{"time_s", "height_mm", "toe_mm", "kinetic_J", "potential_J",
                                      "stress_work_J", "boundary_work_J", "volume_mm3", "inertia_scaling"}));
  EXPECT_EQ(cell(history, 0, "time_s"), 0.0);
  // a cylinder of radius 39 and height 140 mm: volume, and m g h/2 at 1337.35 kg/m3
  EXPECT_NEAR(cell(history, 0, "volume_mm3"), 668971.0, 1.0);
  EXPECT_NEAR(cell(history, 0, "potential_J"), 1337.35 * 668971e-9 * 9.81 * 0.07, 1e-4);
  EXPECT_EQ(datasets::read_outlines(root_ / "out/outlines.csv").size(), 2U);
}

}  // namespace
}  // namespace isotach::reports
