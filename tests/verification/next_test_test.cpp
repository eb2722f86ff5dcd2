// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Whether tests leave the standard errors that were foretold of them: many synthetic data sets of a
// candidate, each fitted.
#include "calibration/next_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "calibration/oedometer_information.hpp"
#include "calibration/slump_information.hpp"
#include "tests/set_a.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;

constexpr double kReading = 1e-3;  // m

model::Parameters<double> truth() {
  auto values = model::set_a_values();
  values[C_1] = 0.2;
  return model::Parameters<double>::create(values).value();
}

/// A body whose surface is a paraboloid of the fill's volume, lower the smaller I_v is, and the larger C_1 as
/// long as it is early. Cells and points leave it as it is.
tl::expected<mpm::SlumpResult, mpm::RunFailure> paraboloid(const std::string& /*test*/,
                                                           const model::Parameters<double>& parameters,
                                                           const mpm::SlumpSetup& setup) {
  mpm::SlumpResult result;
  for (const double time : setup.times) {
    const double height =
        0.06 + 0.02 * std::log(parameters.I_v() / 0.05) - 0.05 * (parameters.C_1() - 0.2) * std::exp(-time);
    const double radius = 0.5 * setup.mould.diameter;
    const double toe = radius * std::sqrt(2.0 * setup.mould.fill_height / height);
    mpm::Outline outline{time, {}};
    for (int i = 0; i <= 60; ++i) {
      const double r = toe * (1.0 - i / 60.0);
      outline.points.push_back({r, height * (1.0 - r * r / (toe * toe))});
    }
    result.outlines.push_back(std::move(outline));
  }
  mpm::HistoryRow end{};  // at rest
  end.time = setup.times.back();
  end.potential = 1.0;
  result.history.push_back(end);
  return result;
}

datasets::SlumpTest slump(const std::string& name, double fill, const std::vector<double>& times) {
  datasets::SlumpTest test{name, {}, {}, {}, {kReading, kReading, 0.0}, false};
  test.setup.mould.fill_height = fill;
  test.setup.mud.void_ratio = 4.0;
  test.setup.times = times;
  const auto run = *paraboloid(name, truth(), test.setup);
  for (const mpm::Outline& outline : run.outlines) {
    datasets::Outline read{outline.time, {}};
    for (const mpm::OutlinePoint& point : experiments::resampled(outline.points, 30)) {
      read.points.push_back({point.r, point.z});
    }
    test.outlines.push_back(std::move(read));
  }
  return test;
}

datasets::Study study_of(std::vector<datasets::SlumpTest> tests) {
  datasets::FitSettings fit;
  fit.oedometer = {};
  fit.gauge = datasets::Gauge::fixed;
  return {.file = {},
          .material = truth(),
          .fit = fit,
          .oedometer_tests = {},
          .slump_tests = std::move(tests),
          .assumptions = {}};
}

/// Standard deviations about the truth of ln I_v and C_1 over fits.
class Scatter {
 public:
  void add(const model::Parameters<double>& found) {
    first_ += std::pow(std::log(found.I_v() / truth().I_v()), 2.0);
    second_ += std::pow(found.C_1() - truth().C_1(), 2.0);
    ++count_;
  }
  [[nodiscard]] double first() const { return std::sqrt(first_ / count_); }
  [[nodiscard]] double second() const { return std::sqrt(second_ / count_); }
  /// Three standard deviations of a standard deviation estimated from so many fits.
  [[nodiscard]] double tolerance() const { return 3.0 / std::sqrt(2.0 * count_); }

 private:
  double first_ = 0.0;
  double second_ = 0.0;
  double count_ = 0.0;
};

/// Fits I_v, C_1 and `more` to the experiments from the truth.
model::Parameters<double> fitted(const Experiments& tests, const std::vector<model::ParameterId>& moved) {
  const Problem problem(tests, Parametrisation(truth(), moved, {}, GaugeChoice{}), 1);
  const OptimiserResult result = minimise_with_ceres(problem, problem.parametrisation().start(), {}, {});
  return problem.parametrisation().at(result.coordinates).value();
}

TEST(NextTestOfSlumps, ScatterAsForetoldWhereTheyAreMadeAndFitted) {
  const datasets::Study study = study_of({slump("present", 0.1, {0.5, 2.0})});
  datasets::Candidates candidates;
  candidates.slumps.push_back(
      {"candidate", "", slump("", 0.14, {0.3, 1.0, 5.0}).setup, {{"", {0.3, 1.0, 5.0}}}});
  NextTestOptions options;
  options.simulate = paraboloid;
  const auto next = rate_candidates(study, candidates, options);
  ASSERT_TRUE(next.has_value()) << next.error().message;
  ASSERT_EQ(next->candidates.size(), 1U);
  const Outlook& foretold = next->candidates.front().with_present;
  EXPECT_LT(foretold.log_det, next->present.log_det);

  std::mt19937 random(3);
  std::normal_distribution<double> reading(0.0, kReading);
  Scatter scatter;
  for (int k = 0; k < 150; ++k) {
    Experiments tests;
    for (datasets::SlumpTest test : {study.slump_tests.front(), slump("candidate", 0.14, {0.3, 1.0, 5.0})}) {
      for (datasets::Outline& outline : test.outlines) {
        for (datasets::OutlinePoint& point : outline.points) {
          point.r += reading(random);
          point.z += reading(random);
        }
      }
      tests.push_back(std::make_shared<experiments::SlumpExperiment>(
          test, experiments::SlumpModel{.simulate = paraboloid}));
    }
    scatter.add(fitted(tests, {I_v, C_1}));
  }
  EXPECT_NEAR(scatter.first() / foretold.first, 1.0, scatter.tolerance());
  EXPECT_NEAR(scatter.second() / foretold.second, 1.0, scatter.tolerance());
}

TEST(NextTestOfOedometers, ScatterAsForetoldWhereTheyAreMadeAndFitted) {
  datasets::Study study = study_of({});
  study.fit.oedometer = {e100, lambda, kappa};
  datasets::Candidates candidates;
  using enum datasets::Stage;
  candidates.oedometers.push_back({"steps",
                                   "",
                                   {{load, 0.1, 1e-6, 0.0},
                                    {load, 0.13, 1e-5, 0.0},
                                    {unload, 0.12, 1e-6, 0.0},
                                    {load, 0.2, 1e-7, 0.0},
                                    {relax, 0.2, 0.0, 1e5},
                                    {load, 0.25, 1e-6, 0.0}},
                                   120,
                                   1.6,
                                   20e3,
                                   0.8});
  const auto next = rate_candidates(study, candidates, {});
  ASSERT_TRUE(next.has_value()) << next.error().message;
  const Outlook& foretold = next->candidates.front().with_present;
  ASSERT_TRUE(std::isfinite(foretold.log_det));
  EXPECT_EQ(next->candidates.front().directions, 5);
  EXPECT_LT(next->candidates.front().with_present_held.first, foretold.first)
      << "who holds e100, lambda and kappa pretends to know more";

  const auto exact = test_of(candidates.oedometers.front(), setting_of(study, truth()), truth());
  ASSERT_TRUE(exact.has_value()) << exact.error();
  const experiments::OedometerExperiment exactly(*exact);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Scatter scatter;
  for (int k = 0; k < 80; ++k) {
    datasets::OedometerTest test = *exact;
    for (std::size_t i = 0; i < exactly.values().size(); ++i) {
      test.record.rows[exactly.values()[i].row].axial_stress *= std::exp(exactly.noise()[i] * normal(random));
    }
    scatter.add(
        fitted({std::make_shared<experiments::OedometerExperiment>(test)}, {e100, lambda, kappa, I_v, C_1}));
  }
  EXPECT_NEAR(scatter.first() / foretold.first, 1.0, scatter.tolerance());
  EXPECT_NEAR(scatter.second() / foretold.second, 1.0, scatter.tolerance());
}

TEST(NextTest, ACandidateThatCannotBeSimulatedIsNamedAndTheOthersAreRated) {
  const datasets::Study study = study_of({slump("present", 0.1, {0.5, 2.0})});
  datasets::Candidates candidates;
  for (const char* name : {"good", "bad"}) {
    candidates.slumps.push_back({name, "both", slump("", 0.14, {1.0}).setup, {{"", {1.0}}}});
  }
  NextTestOptions options;
  options.simulate = [](const std::string& name, const auto& parameters,
                        const auto& setup) -> tl::expected<mpm::SlumpResult, mpm::RunFailure> {
    if (name == "bad") return tl::unexpected(mpm::RunFailure{mpm::RunStatus::crashed, "it burst"});
    return paraboloid(name, parameters, setup);
  };
  const auto next = rate_candidates(study, candidates, options);
  ASSERT_TRUE(next.has_value()) << next.error().message;
  EXPECT_EQ(next->candidates[0].failure, "");
  EXPECT_EQ(next->candidates[1].failure, "it burst");
  ASSERT_EQ(next->programmes.size(), 1U);
  EXPECT_EQ(next->programmes[0].tests, (std::vector<std::size_t>{0}));
  // the sequence takes the only one again and again, each time for less
  ASSERT_GE(next->sequence.size(), 2U);
  EXPECT_LT(next->sequence[1].after.log_det, next->sequence[0].after.log_det);
}

TEST(NextTest, MorePicturesNeverTellLess) {
  const datasets::Study study = study_of({slump("present", 0.1, {0.5, 2.0})});
  datasets::Candidates candidates;
  candidates.slumps.push_back({"one",
                               "",
                               slump("", 0.14, {0.5, 1.0, 4.0}).setup,
                               {{"all", {0.5, 1.0, 4.0}}, {"early", {0.5, 1.0}}, {"first", {0.5}}}});
  NextTestOptions options;
  options.simulate = paraboloid;
  const auto next = rate_candidates(study, candidates, options);
  ASSERT_TRUE(next.has_value()) << next.error().message;
  ASSERT_EQ(next->candidates.size(), 3U);
  EXPECT_LT(next->candidates[0].with_present.log_det, next->candidates[1].with_present.log_det);
  EXPECT_LT(next->candidates[1].with_present.log_det, next->candidates[2].with_present.log_det);
}

}  // namespace
}  // namespace isotach::calibration
