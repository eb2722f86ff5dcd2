// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the reports of the commands: what a reader must find in them.
#include <gtest/gtest.h>

#include "reports/calibration_report.hpp"
#include "reports/number.hpp"
#include "reports/oedometer_report.hpp"
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

TEST(OedometerReport, ShowsFitResidualsAndGauge) {
  const std::string html =
      oedometer_report(run_of("fit-oedometer"), small_study(), small_calibration().oedometer).html();
  expect_parts(html, {"isotach fit-oedometer · version 1.2.3 · mud-a/study.toml", "crs-3 (held out)",
                      "Held out and predicted", "lambda", "swelling index", "set by the gauge",
                      "D_r (1+e100)^(−1/(λ I_v))", "Ceres (Levenberg-Marquardt)", "NLopt (BOBYQA)",
                      "crs-2.csv", "No row had to be mended"});
  // for each of two tests a curve and two views of the residuals, and the convergence
  EXPECT_EQ(count(html, "<svg "), 7U);
  EXPECT_EQ(count(html, "private"), 0U);
}

TEST(OedometerReport, NamesRowsLeftOutAndWhatWasDeduced) {
  calibration::OedometerFit fit = small_calibration().oedometer;
  datasets::OedometerTest test = fit.experiments[0]->test();
  test.record.notes = {{264, "dropped: no positive stress"}};
  test.record.unknown_columns = {"humidity"};
  test.record.stages_deduced = true;
  fit.experiments[0] = std::make_shared<experiments::OedometerExperiment>(test);
  const std::string html = oedometer_report(run_of("fit-oedometer"), small_study(), fit).html();
  expect_parts(html, {"264", "dropped: no positive stress", "columns not read: humidity", "no stage column"});
  EXPECT_EQ(count(html, "No row had to be mended"), 0U);
}

TEST(OedometerReport, SaysThatAModelIsNotAdequate) {
  calibration::OedometerFit fit = small_calibration().oedometer;
  fit.result.adequate = false;
  fit.result.tests[0].rms_over_noise = 7.25;
  const std::string html = oedometer_report(run_of("fit-oedometer"), small_study(), fit).html();
  expect_parts(html, {"The model is not adequate for the fitted oedometer tests", "crs-2 (7.25)"});
  EXPECT_EQ(count(html, "The model is adequate"), 0U);
}

TEST(OedometerReport, ShowsTheNullDirectionOfAFitWithoutGauge) {
  datasets::Study study = small_study();
  study.fit.gauge = datasets::Gauge::none;
  const auto fit = calibration::fit_oedometer(study, study.material, study.fit.oedometer, {});
  ASSERT_TRUE(fit);
  const std::string html = oedometer_report(run_of("fit-oedometer"), study, *fit).html();
  expect_parts(html, {"No gauge was set", "These data do not determine e100",
                      "The data do not see the following move"});
}

TEST(SlumpFitReport, ShowsOutlinesAndSaysWhatCannotBeKnown) {
  const std::string html =
      slump_fit_report(run_of("fit-slump"), small_study(), small_calibration().slump).html();
  expect_parts(html, {"slump-2", "slump-4 (held out)", "slump-4.csv", "factor (1 − C_1) on the rate",
                      "artificial viscosity α", "bulk modulus of the water 300 kPa", "Floored", "13.0 mm"});
  // two tests; cost, I_v and C_1 against evaluations
  EXPECT_EQ(count(html, "<svg "), 5U);
}

TEST(SlumpReport, ShowsOneRun) {
  const std::string html = slump_report(run_of("slump"), short_slump_test(), short_slump()).html();
  const mpm::Outline& last = short_slump().outlines.back();
  expect_parts(html, {"Slump test, simulated", "smooth wall", "Imbalance",
                      format_number(1e3 * last.height()).c_str(), format_number(1e3 * last.toe()).c_str()});
  EXPECT_EQ(count(html, "<svg "), 3U);  // outlines, height and toe, energies
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
  EXPECT_EQ(count(html, "<svg "), 12U);
  // one answer: one table of parameters with their verdicts
  EXPECT_EQ(count(html, ">gauge</td>"), 1U);
}

TEST(CalibrationReport, ComparesIvOfBothKindsOfTest) {
  calibration::Calibration calibration = small_calibration();
  const auto I_v = static_cast<std::size_t>(model::ParameterId::I_v);
  calibration.first_oedometer.result.free.push_back(model::ParameterId::I_v);
  calibration.slump.result.estimates[I_v] = {model::ParameterId::I_v,         0.03, 0.001, 0.028, 0.032,
                                             calibration::Verdict::identified};
  auto& estimate = calibration.first_oedometer.result.estimates[I_v];
  // ln(0.0325/0.03) = 0.08004 over hypot(0.001/0.0325, 0.001/0.03) = 0.04536
  estimate = {model::ParameterId::I_v, 0.0325, 0.001, 0.0306, 0.0345, calibration::Verdict::identified};
  expect_parts(calibration_report(run_of("calibrate"), small_study(), calibration).html(),
               {"1.8 combined standard errors of ln I_v apart, so the two kinds of test agree"});
  // ln(0.05/0.03) = 0.5108 over hypot(0.02, 0.001/0.03) = 0.03887
  estimate = {model::ParameterId::I_v, 0.05, 0.001, 0.048, 0.052, calibration::Verdict::identified};
  expect_parts(calibration_report(run_of("calibrate"), small_study(), calibration).html(),
               {"13 combined standard errors of ln I_v apart, so the model is not right for both"});
}

}  // namespace
}  // namespace isotach::reports
