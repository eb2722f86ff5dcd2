// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of the figures of oedometer curves: what is drawn, and where.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reports/compression_figures.hpp"
#include "reports/start_section.hpp"
#include "reports/time_figures.hpp"
#include "reports_load_steps.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

const Series& series_named(const Figure& figure, const std::string& label) {
  const auto found = std::find_if(figure.series.begin(), figure.series.end(),
                                  [&](const Series& series) { return series.label == label; });
  if (found == figure.series.end()) throw std::invalid_argument("no series " + label);
  return *found;
}

std::size_t count_of(const Figure& figure, SeriesStyle style) {
  return static_cast<std::size_t>(std::count_if(figure.series.begin(), figure.series.end(),
                                                [&](const Series& series) { return series.style == style; }));
}

TEST(CompressionFigures, DrawIsotachsAtDecadesAboutTheRateOfTheTest) {
  const std::vector<TestView> views = views_of(assessed_fit());
  const TestView& view = views.front();
  const double rate = view.experiment.protocol().first_loading_rate.value();
  ASSERT_GE(view.isotachs.size(), 3U);
  for (const integrators::Isotach& isotach : view.isotachs) {
    const double decade = std::log10(isotach.axial_strain_rate());
    EXPECT_NEAR(decade, std::round(decade), 1e-9);
  }
  EXPECT_LT(view.isotachs.front().axial_strain_rate(), rate);
  EXPECT_GE(view.isotachs.back().axial_strain_rate(), rate * (1.0 - 1e-9));

  const Figure figure = void_ratio_figure(view);
  EXPECT_EQ(count_of(figure, SeriesStyle::thin_dashed), view.isotachs.size());
  ASSERT_FALSE(figure.annotations.empty());
  EXPECT_NE(figure.annotations.front().text.find("/s"), std::string::npos);
  // behind the data: drawn before them, and within the frame
  EXPECT_EQ(figure.series.front().style, SeriesStyle::thin_dashed);
  for (const Series& series : figure.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      EXPECT_GE(series.x[i], *figure.x.min * (1.0 - 1e-12));
      EXPECT_LE(series.x[i], *figure.x.max * (1.0 + 1e-12));
      EXPECT_GE(series.y[i], *figure.y.min);
      EXPECT_LE(series.y[i], *figure.y.max);
    }
  }
}

TEST(CompressionFigures, ModelLiesOnItsIsotachInVirginCompression) {
  // crs-2 ends loading in steady compression at its own rate: there the model's curve is the isotach of that
  // rate, to the K0 that is still on its way
  const std::vector<TestView> views = views_of(assessed_fit());
  const TestView& view = views.front();
  const auto highest = std::max_element(view.path.begin(), view.path.end(), [](const auto& a, const auto& b) {
    return a.axial_stress < b.axial_stress;
  });
  const auto before = highest - 1;
  const double rate =
      std::log((1.0 - before->axial_strain) / (1.0 - highest->axial_strain)) / (highest->time - before->time);
  const auto isotach = integrators::Isotach::create(*assessed_fit().result.parameters, rate).value();
  EXPECT_NEAR(view.void_ratio_on(isotach, highest->axial_stress),
              view.void_ratio_of_strain(highest->axial_strain), 2e-3);
}

TEST(CompressionFigures, StrainIncreasesDownwards) {
  const std::vector<TestView> views = views_of(assessed_fit());
  const Figure figure = strain_figure(views.front());
  EXPECT_TRUE(figure.y.reversed);
  EXPECT_TRUE(figure.x.logarithmic);
  const Series& measured = series_named(figure, "measured");
  const auto& rows = views.front().experiment.test().record.rows;
  ASSERT_EQ(measured.y.size(), rows.size());
  EXPECT_NEAR(measured.y.front(), 100.0 * rows.front().axial_strain, 1e-9);
  EXPECT_NEAR(measured.y.back(), 100.0 * rows.back().axial_strain, 1e-9);
  EXPECT_LT(*figure.y.min, *figure.y.max);
}

TEST(CompressionFigures, LoadStepsShowTheirEnds) {
  const calibration::OedometerFit fit = load_step_fit(small_study().material);
  const std::vector<TestView> views = views_of(fit);
  const Figure figure = void_ratio_figure(views.front());
  EXPECT_EQ(series_named(figure, "measured").x, (std::vector<double>{20.0, 40.0, 80.0, 40.0}));
  // with the start in front
  const Series& model = series_named(figure, "model, fitted");
  ASSERT_EQ(model.x.size(), 5U);
  EXPECT_NEAR(model.x[0], 10.0, 1e-9);
  EXPECT_NEAR(model.y[0], 2.2, 1e-12);
  EXPECT_NEAR(model.y[3], series_named(figure, "measured").y[2], 1e-12);
}

TEST(TimeFigures, ShowEachLoadStepWithWhatIsCompared) {
  const calibration::OedometerFit fit = load_step_fit(small_study().material);
  const std::vector<TestView> views = views_of(fit);
  const std::vector<Figure> figures = time_figures(views.front());
  ASSERT_EQ(figures.size(), 3U);  // the unloading has a single reading
  for (const Figure& figure : figures) {
    EXPECT_TRUE(figure.x.logarithmic);
    EXPECT_TRUE(figure.y.reversed);
    EXPECT_EQ(series_named(figure, "measured").x.size(), 3U);
    EXPECT_EQ(series_named(figure, "measured, compared").x.size(), 3U);
    EXPECT_GE(series_named(figure, "model").x.size(), kReadingsPerStep);
    ASSERT_EQ(figure.markers.size(), 1U);
    // 80000 s are shown in hours
    EXPECT_NEAR(figure.markers.front().at, kEndOfPrimary / 3600.0, 1e-12);
    EXPECT_NEAR(series_named(figure, "measured, compared").x.front(), 1000.0 / 3600.0, 1e-9);
  }
  EXPECT_NE(figures[2].caption.find("80.00 kPa"), std::string::npos);
}

TEST(TimeFigures, ShowCreepSinceTheHoldBeganAndRelaxationAsStress) {
  calibration::OedometerFit fit = assessed_fit();
  datasets::OedometerTest test = fit.experiments[0]->test();
  test.record.stages_deduced = false;
  auto& rows = test.record.rows;
  for (std::size_t i = 100; i < 110; ++i) rows[i].stage = datasets::Stage::hold;
  for (std::size_t i = 130; i < 140; ++i) rows[i].stage = datasets::Stage::relax;
  for (std::size_t i = 100; i < 110; ++i) rows[i].axial_stress = rows[100].axial_stress;
  fit.experiments = {std::make_shared<experiments::OedometerExperiment>(test)};
  fit.locals.resize(1);
  fit.result.tests.resize(1);
  fit.noise = {};
  fit.evaluation =
      calibration::evaluate_all({fit.experiments[0]}, *fit.result.parameters, fit.locals, 1).value();
  const std::vector<TestView> views = views_of(fit);
  std::vector<Figure> figures = time_figures(views.front());
  const auto captioned = [&](const char* part) {
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& figure) {
      return figure.caption.find(part) != std::string::npos;
    });
    if (found == figures.end()) throw std::invalid_argument(part);
    return *found;
  };
  const Figure creep = captioned("creep at");
  EXPECT_EQ(creep.y.label, "axial strain since then (%)");
  EXPECT_EQ(series_named(creep, "measured").x.size(), 10U);
  const Figure relaxation = captioned("relaxation from");
  EXPECT_EQ(relaxation.y.label, "axial effective stress (kPa)");
  EXPECT_NEAR(series_named(relaxation, "measured").y.front(), 1e-3 * rows[130].axial_stress, 1e-9);
}

TEST(StartSection, DrawsLinesOnlyWhereTheyCanBeDrawn) {
  calibration::Constructions drawn{.virgin = tl::unexpected(std::string("too few points")),
                                   .swelling = {},
                                   .casagrande = tl::unexpected(std::string("no bend")),
                                   .becker = tl::unexpected(std::string("no bend")),
                                   .rate_steps = {},
                                   .relaxation = {},
                                   .creep = {}};
  EXPECT_TRUE(construction_lines(drawn).empty());
  // ln(1+e) = 2 - 0.1 ln(sigma/1 Pa): at 100 kPa e = exp(2 - 0.1 * 11.51293) - 1 = 1.33662
  drawn.virgin = calibration::VirginLine{{-0.1, 2.0, 50e3, 100e3, 7}, 1e-6};
  const auto lines = construction_lines(drawn);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].name, "virgin line");
  EXPECT_NEAR(lines[0].stress.back(), 100.0, 1e-9);
  EXPECT_NEAR(lines[0].void_ratio.back(), 1.33662, 1e-5);
}

}  // namespace
}  // namespace isotach::reports
