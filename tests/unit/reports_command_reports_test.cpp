// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the reports of the commands: what a reader must find in them.
#include <gtest/gtest.h>

#include "reports/calibration_report.hpp"
#include "reports/number.hpp"
#include "reports/slump_fit_report.hpp"
#include "reports/slump_report.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

void expect_parts(const std::string& html, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_GT(count(html, part), 0U) << part;
}

TEST(SlumpFitReport, ShowsOutlinesAndSaysWhatCannotBeKnown) {
  const std::string html =
      slump_fit_report(run_of("fit-slump"), small_study(), small_calibration().slump).html();
  expect_parts(
      html, {"slump-2", "slump-4 (held out)", "slump-4.csv", "factor (1 − C_1) on the rate",
             "0.20 Pa s beside the law", "bulk modulus of the water 300 kPa", "Floored", "cells of 9.75 mm",
             "Reference numerics", "cells of 13.0 mm, conserving scheme, is corrected to them"});
  // two tests; cost, I_v and C_1 against evaluations
  EXPECT_EQ(count(html, "<svg "), 5U);
}

TEST(SlumpFitReport, SaysHowWellOutlinesHoldWhatWasFittedAndWhereTheyDoNot) {
  const calibration::SlumpFit& fit = small_calibration().slump_alone;
  ASSERT_TRUE(fit.map.has_value());
  const std::string html = slump_fit_report(run_of("fit-slump"), small_study(), fit).html();
  expect_parts(
      html, {"How well the outlines hold what was fitted", "principal components",
             "95 % intervals by profile", "Where simulation and data disagree most",
             "3 cells across the radius instead of 4", "9 points a cell instead of 4", "Volume (%)", "CRS2"});
  // two tests; map; two profiles; cost, I_v and C_1 against evaluations
  EXPECT_EQ(count(html, "<svg "), 8U);
  const calibration::ParameterEstimate& I_v =
      fit.result.estimates[static_cast<std::size_t>(model::ParameterId::I_v)];
  const calibration::Profile& profile = fit.map->profiles.front();
  EXPECT_DOUBLE_EQ(I_v.ci95_lower, std::exp(profile.lower)) << "intervals are the profile's";
}

TEST(SlumpReport, ShowsOneRun) {
  const std::string html = slump_report(run_of("slump"), short_slump_test(), short_slump()).html();
  const mpm::Outline& last = short_slump().outlines.back();
  expect_parts(html, {"Slump test, simulated", "smooth wall", "Imbalance",
                      format_number(1e3 * last.height()).c_str(), format_number(1e3 * last.toe()).c_str()});
  EXPECT_EQ(count(html, "<svg "), 6U);  // outlines, height and toe, energies; |D|, OCR, in motion
}

TEST(SlumpReport, ShowsFieldsAndMovesWhereTheRunTookFrames) {
  std::string html = slump_report(run_of("slump"), short_slump_test(), short_slump()).html();
  expect_parts(html, {"Strain rate and overconsolidation", "Strain rate |D| at output times",
                      "Overconsolidation ratio at output times", "8 s a loop", "<b>Figure 6.</b>"});
  const auto count = [&](std::string_view text) {
    std::size_t found = 0;
    for (std::size_t at = html.find(text); at != std::string::npos; at = html.find(text, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("class=\"panel\""), 2U * short_slump_test().setup.times.size());
  EXPECT_EQ(count("class=\"frame\""), 10U);
  mpm::SlumpResult plain = short_slump();
  plain.frames.clear();
  plain.fields.clear();
  html = slump_report(run_of("slump"), short_slump_test(), plain).html();
  EXPECT_EQ(count("data:image"), 0U);
  EXPECT_EQ(count("Strain rate and overconsolidation"), 0U);
}

TEST(SlumpReport, SaysWhatTheMudStandsOn) {
  datasets::SlumpFile test = short_slump_test();
  const auto html = [&] { return slump_report(run_of("slump"), test, short_slump()).html(); };
  mpm::Base& base = test.setup.base;
  base = {};
  expect_parts(html(), {"Base", "rough"});
  base.friction.adhesion = 50.0;
  base.friction.friction = 0.25;
  expect_parts(html(), {"adhesion 0.0500 kPa, friction 0.250"});
  base.friction = {};
  base.friction.slip_length = 0.002;
  expect_parts(html(), {"slip length 2.00 mm"});
  base.friction = {};
  base.slab = mpm::ElasticSlab{};
  expect_parts(html(),
               {"elastic slab, 5.00 mm thick, to 200 mm from the axis, E = 1000 kPa, ν = 0.30, rough"});
}

TEST(SlumpReport, WarnsOfBudgetsThatDoNotClose) {
  mpm::SlumpResult result = short_slump();
  result.volume_error = 0.001;
  result.energy_error = 0.055;
  const std::string html = slump_report(run_of("slump"), short_slump_test(), result).html();
  expect_parts(html,
               {"Volume is kept to within 0.10 %.", "to within 5.5 %, more than the 2 % to be expected"});
}

TEST(CalibrationReport, HoldsTheChainAndBothFits) {
  const calibration::Calibration& calibration = small_calibration();
  const std::string html = calibration_report(run_of("calibrate"), small_study(), calibration).html();
  expect_parts(html, {"The chain of fits", "crs-3 (held out)", "slump-4 (held out)",
                      "does not let the oedometer fit move I_v", "Identified: half the 95 % interval"});
  // sections of the oedometer's fit stand under its name, those of its assessment too
  expect_parts(html,
               {"Oedometer: Compression curves", "Oedometer: Robustness", "Oedometer: Data and assumptions"});
  // one answer: one table of parameters with their verdicts
  EXPECT_EQ(count(html, ">gauge</td>"), 1U);
  ASSERT_TRUE(small_calibration().joint.has_value()) << small_calibration().joint_failure;
  expect_parts(html, {"Both kinds of test at once", "Parameters by each kind of test and by both"});
}

TEST(CalibrationReport, ComparesIvOfBothKindsOfTest) {
  calibration::Calibration calibration = small_calibration();
  const auto I_v = static_cast<std::size_t>(model::ParameterId::I_v);
  calibration.first_oedometer.result.free.push_back(model::ParameterId::I_v);
  calibration.slump_alone.result.estimates[I_v] = {model::ParameterId::I_v,         0.03, 0.001, 0.028, 0.032,
                                                   calibration::Verdict::identified};
  auto& estimate = calibration.first_oedometer.result.estimates[I_v];
  // ln(0.0325/0.03) = 0.08004 over hypot(0.001/0.0325, 0.001/0.03) = 0.04536
  estimate = {model::ParameterId::I_v, 0.0325, 0.001, 0.0306, 0.0345, calibration::Verdict::identified};
  expect_parts(calibration_report(run_of("calibrate"), small_study(), calibration).html(),
               {"1.8 combined standard errors of ln I_v apart, so the two kinds of test agree"});
  calibration.slump.result.adequate = false;
  // ln(0.05/0.03) = 0.5108 over hypot(0.02, 0.001/0.03) = 0.03887
  estimate = {model::ParameterId::I_v, 0.05, 0.001, 0.048, 0.052, calibration::Verdict::identified};
  expect_parts(calibration_report(run_of("calibrate"), small_study(), calibration).html(),
               {"13 combined standard errors of ln I_v apart, so no one set of parameters serves both"});
  calibration.oedometer.result.adequate = calibration.slump.result.adequate = true;
  expect_parts(calibration_report(run_of("calibrate"), small_study(), calibration).html(),
               {"ln I_v apart, though one set of parameters meets all fitted tests"});
}

}  // namespace
}  // namespace isotach::reports
