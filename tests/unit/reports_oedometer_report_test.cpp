// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the report of an oedometer fit: verdicts that name where, and sections that show what there is.
#include <gtest/gtest.h>

#include <cmath>

#include "reports/oedometer_report.hpp"
#include "reports/oedometer_summary.hpp"
#include "reports/residual_section.hpp"
#include "reports/robustness_section.hpp"
#include "reports/search_section.hpp"
#include "reports/uncertainty_section.hpp"
#include "reports_load_steps.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

void expect_parts(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_GT(count(text, part), 0U) << part;
}

std::string html_of(const calibration::OedometerFit& fit) {
  return oedometer_report(run_of("fit-oedometer"), assessed_study(), fit).html();
}

calibration::StageCheck missed_stage(const std::string& name, double rms, double mean) {
  return {name, 0.0, 10.0, 1e3, 2e3, 20, rms, mean, 1e-9, true};
}

TEST(OedometerReport, ShowsAllOfAnAssessedFit) {
  const std::string html = html_of(assessed_fit());
  expect_parts(html, {"isotach fit-oedometer · version 1.2.3 · mud-a/study.toml",
                      "crs-3 (held out)",
                      "Held out and predicted",
                      "Compression curves",
                      "isotachs",
                      "Start values read off the constructions",
                      "yield at",
                      "Residuals by stage",
                      "Noise, stated by the study and estimated",
                      "normal distribution",
                      "crosses the threshold at",
                      "95 % intervals by different means",
                      "Bootstrap",
                      "Correlation of the fitted coordinates",
                      "background:#",
                      "Different answers from different starts",
                      "NLopt (BOBYQA)",
                      "Only one test is fitted",
                      "Influence of assumed inputs",
                      "CVODE",
                      "set by the gauge",
                      "D_r (1+e100)^(−1/(λ I_v))",
                      "crs-2.csv",
                      "No row had to be mended",
                      "No test has base pore pressures",
                      "Verdict on the model. Adequate:",
                      "swelling index"});
  EXPECT_EQ(count(html, "private"), 0U);
  EXPECT_EQ(count(html, "nan"), 0U);
}

TEST(OedometerReport, LeavesOutWhatAFitWithoutAssessmentHasNot) {
  calibration::OedometerFit fit = assessed_fit();
  fit.assessment.reset();
  fit.start.reset();
  const std::string html = html_of(fit);
  expect_parts(html, {"Residuals by stage", "The fit started from the material of the study"});
  for (const char* part : {"crosses the threshold", "Robustness", "Different answers", "Bootstrap"}) {
    EXPECT_EQ(count(html, part), 0U) << part;
  }
}

TEST(OedometerReport, NamesRowsLeftOutAndWhatWasDeduced) {
  calibration::OedometerFit fit = assessed_fit();
  datasets::OedometerTest test = fit.experiments[0]->test();
  test.record.notes = {{264, "dropped: no positive stress"}};
  test.record.unknown_columns = {"humidity"};
  test.record.stages_deduced = true;
  test.record.pore_pressure = {datasets::PorePressureFormula::nonlinear, 0.012, 0.21, 190, 17};
  fit.experiments[0] = std::make_shared<experiments::OedometerExperiment>(test);
  const std::string html = html_of(fit);
  expect_parts(html, {"264", "dropped: no positive stress", "columns not read: humidity", "no stage column",
                      "nonlinear", "1.2 %", "21 %"});
  EXPECT_EQ(count(html, "No row had to be mended"), 0U);
}

TEST(OedometerReport, ShowsLoadStepsAndTheirPrimaryConsolidation) {
  datasets::Study study = small_study();
  const std::string html =
      oedometer_report(run_of("fit-oedometer"), study, load_step_fit(study.material)).html();
  expect_parts(html, {"Creep and relaxation", "End of primary consolidation of each load step", "il-1.csv",
                      "load steps", "end of primary", "200 s"});
}

TEST(OedometerSummary, SaysThatAllIsMet) {
  const std::string sentence = adequacy_sentence(assessed_fit());
  expect_parts(sentence, {"The model is adequate"});
  EXPECT_EQ(count(sentence, "not adequate"), 0U);
}

TEST(OedometerSummary, NamesTheStagesThatAreMissedTheWorstFirst) {
  calibration::OedometerFit fit = assessed_fit();
  fit.result.adequate = false;
  fit.checks[0].stages = {missed_stage("load", 1.5, 1.4), missed_stage("unload 2", 7.25, -7.0),
                          missed_stage("relax", 2.0, 0.1)};
  const std::string sentence = adequacy_sentence(fit);
  expect_parts(sentence, {"The model is not adequate", "crs-2", "unload 2 (7.25 × noise, model below)",
                          "relax (2.00 × noise, model above and below)", "load (1.50 × noise, model above)"});
  EXPECT_LT(sentence.find("unload 2"), sentence.find("relax"));
  EXPECT_LT(sentence.find("relax"), sentence.find("load (1.50"));
}

TEST(OedometerSummary, SaysWhereNoSingleStageStandsOut) {
  calibration::OedometerFit fit = assessed_fit();
  fit.result.adequate = false;
  fit.result.tests[0].rms_over_noise = 1.42;
  for (calibration::StageCheck& stage : fit.checks[0].stages) stage.misfit = false;
  expect_parts(adequacy_sentence(fit), {"crs-2 (1.42), as a whole: no single stage stands out"});
}

TEST(OedometerSummary, SaysHowHeldOutTestsArePredicted) {
  calibration::OedometerFit fit = assessed_fit();
  fit.result.tests[1].rms_over_noise = 0.98;
  for (calibration::StageCheck& stage : fit.checks[1].stages) stage.misfit = false;
  EXPECT_EQ(prediction_sentence(fit), "Held out and predicted, not fitted: crs-3 to within 0.980 × noise.");
  fit.result.tests[1].rms_over_noise = 3.0;
  EXPECT_EQ(prediction_sentence(fit),
            "Held out and predicted, not fitted: not met: crs-3 to within 3.00 × noise.");
  fit.result.tests.pop_back();
  EXPECT_EQ(prediction_sentence(fit), "");
}

TEST(OedometerSummary, SaysThatAPatternIsLeft) {
  calibration::OedometerFit fit = assessed_fit();
  fit.checks[0].whitened.p_value = 1e-6;
  expect_parts(pattern_sentence(fit), {"Residuals of crs-2 keep a pattern"});
  fit.checks[0].whitened.p_value = 0.5;
  EXPECT_EQ(pattern_sentence(fit), "");
}

TEST(OedometerReport, ShowsTheNullDirectionOfAFitWithoutGauge) {
  datasets::Study study = assessed_study();
  study.fit.gauge = datasets::Gauge::none;
  calibration::OedometerFitOptions options;
  options.depth = calibration::Depth::answer;
  const auto fit = calibration::fit_oedometer(study, study.material, study.fit.oedometer, options);
  ASSERT_TRUE(fit);
  const std::string html = oedometer_report(run_of("fit-oedometer"), study, *fit).html();
  expect_parts(html, {"No gauge was set", "These data do not determine e100",
                      "The data do not see the following move: ln e100 by"});
}

TEST(UncertaintySection, NamesTheEndsOfAProfile) {
  const calibration::FitResult& result = assessed_fit().result;
  calibration::Profile profile = assessed_fit().assessment->profiles.at(1);
  ASSERT_EQ(result.coordinates[profile.coordinate].name, "lambda");
  profile.lower = std::log(0.1);
  profile.upper = std::log(0.3);
  profile.lower_end = calibration::ProfileEnd::open;
  profile.upper_end = calibration::ProfileEnd::bound;
  const Figure figure = profile_figure(result, profile);
  EXPECT_EQ(figure.caption,
            "lambda: below, open as far as was looked, 0.100; above, bound reached at 0.300.");
  ASSERT_EQ(figure.series.size(), 2U);
  EXPECT_EQ(figure.series[0].style, SeriesStyle::dashed);
  ASSERT_EQ(figure.markers.size(), 1U);
  EXPECT_EQ(figure.markers[0].at, profile.threshold);
  // the parabola is 1 where the coordinate is one standard error off; of ln lambda that is se/lambda
  const calibration::ParameterEstimate& lambda =
      result.estimates[static_cast<std::size_t>(model::ParameterId::lambda)];
  const Series& parabola = figure.series[0];
  for (std::size_t i = 0; i < parabola.x.size(); ++i) {
    const double errors = std::log(parabola.x[i] / lambda.value) / (lambda.std_error / lambda.value);
    EXPECT_NEAR(parabola.y[i], errors * errors, 1e-6 * (1.0 + errors * errors));
  }
}

TEST(UncertaintySection, IntervalsAreMarkedWhereAProfileIsOpen) {
  calibration::OedometerFit fit = assessed_fit();
  fit.assessment->profiles[0].upper_end = calibration::ProfileEnd::open;
  const Table table = interval_table(fit);
  ASSERT_EQ(table.rows.size(), 3U);
  ASSERT_EQ(table.header.size(), 5U);  // with the bootstrap
  EXPECT_NE(table.rows[0][3].find("(open)"), std::string::npos);
  EXPECT_EQ(table.rows[1][3].find("("), std::string::npos);
}

TEST(RobustnessSection, ShiftsAreInUnitsAndInStandardErrors) {
  calibration::OedometerFit fit = assessed_fit();
  calibration::Refit refit;
  refit.what = "phi_c + 2 deg";
  model::ParameterValues<double> values = fit.result.parameters->values();
  values[model::ParameterId::kappa] += 0.0005;
  refit.parameters = model::Parameters<double>::create(values).value();
  refit.shift = {0.0, -0.1, 2.5};
  refit.rms_over_noise = 1.25;
  fit.assessment->shifted_inputs = {refit};
  const Table table = input_table(fit);
  EXPECT_EQ(table.header, (std::vector<std::string>{"", "phi_c + 2 deg"}));
  EXPECT_EQ(table.rows[2], (std::vector<std::string>{"kappa", "+5.0×10⁻⁴ (+2.5)"}));
  EXPECT_EQ(table.rows[3][0], "D_r (1/s)");  // follows by the gauge
  EXPECT_EQ(table.rows.back()[1], "1.25");
}

TEST(RobustnessSection, AFailedRefitSaysWhy) {
  calibration::OedometerFit fit = assessed_fit();
  calibration::Refit refit;
  refit.what = "without crs-2";
  refit.failure = "no prediction";
  fit.assessment->without_test = {refit};
  const Table table = left_out_table(fit);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1][1], "–");
  EXPECT_EQ(table.notes.back(), "without crs-2: no prediction");
}

TEST(SearchSection, AnswersAreColumns) {
  calibration::FitResult result = assessed_fit().result;
  calibration::MultiStart multi_start;
  Eigen::VectorXd x(3);
  x << std::log(1.5), std::log(0.2), std::log(0.01);
  multi_start.clusters = {{x, result.main.cost, 3}, {x, result.main.cost + 12.0, 1}};
  const Table table = cluster_table(result, multi_start);
  EXPECT_EQ(table.header, (std::vector<std::string>{"", "Answer 1", "Answer 2"}));
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"starts that end there", "3", "1"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"cost above the reported", "0", "12"}));
  EXPECT_EQ(table.rows[3], (std::vector<std::string>{"lambda", "0.2000", "0.2000"}));
}

TEST(ResidualSection, ShadesTheStagesThatAreMissed) {
  calibration::OedometerFit fit = assessed_fit();
  fit.checks.resize(1);
  calibration::StageCheck met = missed_stage("load", 1.0, 0.0);
  met.misfit = false;
  met.p_value = 0.4;
  fit.checks[0].stages = {met, missed_stage("unload", 2.0, 1.9)};
  const Table table = stage_table(fit);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"crs-2", "load", "1.00 to 2.00", "20", "1.00", "0", "0.40", "no"}));
  EXPECT_EQ(table.rows[1],
            (std::vector<std::string>{"", "unload", "1.00 to 2.00", "20", "2.00", "1.9", "< 0.0001", "yes"}));
  EXPECT_FALSE(table.shades[0][0]);
  EXPECT_TRUE(table.shades[1][0]);
}

}  // namespace
}  // namespace isotach::reports
