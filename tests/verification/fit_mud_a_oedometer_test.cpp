// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The oedometer fit on mud-a, whose data another program computed: noise is all that is left, errors are
// stated, two optimisers agree, and what the data cannot hold is the combination that theory says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "calibration/fit_oedometer.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;

const datasets::Study& mud_a() {
  static const datasets::Study study =
      datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
  return study;
}

tl::expected<OedometerFit, FitFailure> fit(datasets::Gauge gauge,
                                           const std::vector<model::ParameterId>& wanted) {
  datasets::Study study = mud_a();
  study.fit.gauge = gauge;
  OedometerFitOptions options;
  options.threads = 2;
  return fit_oedometer(study, study.material, wanted, options);
}

void expect_noise_is_left(const OedometerFit& fit) {
  ASSERT_EQ(fit.result.tests.size(), 3);
  for (const TestSummary& test : fit.result.tests) {
    EXPECT_LE(test.rms_over_noise, 1.3) << test.name << (test.held_out ? ", held out" : "");
    EXPECT_GE(test.rms_over_noise, 0.7) << test.name << ": better than its noise";
    EXPECT_EQ(test.held_out, test.name == "crs-3");
  }
  EXPECT_TRUE(fit.result.adequate);
}

void expect_errors_and_verdicts(const FitResult& result) {
  for (const model::ParameterId id : {e100, lambda, kappa, D_r}) {
    const ParameterEstimate& estimate = result.estimates[static_cast<std::size_t>(id)];
    EXPECT_EQ(estimate.id, id);
    EXPECT_TRUE(std::isfinite(estimate.std_error)) << model::info(id).name;
    EXPECT_GT(estimate.std_error, 0.0) << model::info(id).name;
    EXPECT_LT(estimate.ci95_lower, estimate.value);
    EXPECT_GT(estimate.ci95_upper, estimate.value);
    EXPECT_EQ(estimate.verdict, id == D_r ? Verdict::gauge : Verdict::identified) << model::info(id).name;
  }
}

void expect_optimisers_agree(const FitResult& result) {
  EXPECT_TRUE(result.main.converged) << result.main.termination;
  ASSERT_TRUE(result.check);
  ASSERT_EQ(result.check->coordinates.size(), result.main.coordinates.size());
  for (std::size_t k = 0; k < result.main.coordinates.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double error = std::sqrt(result.uncertainty.covariance(i, i));
    EXPECT_LE(std::abs(result.main.coordinates[k] - result.check->coordinates[k]), 0.1 * error)
        << model::info(result.free[k]).name;
  }
}

TEST(FitMudAOedometer, WithIvFreeLeavesNoise) {
  const auto answer = fit(datasets::Gauge::crs_rate, {e100, lambda, kappa, D_r, C_1, I_v});
  ASSERT_TRUE(answer) << answer.error().message;
  expect_noise_is_left(*answer);
  expect_errors_and_verdicts(answer->result);
  expect_optimisers_agree(answer->result);
  EXPECT_EQ(answer->result.estimates[static_cast<std::size_t>(I_v)].verdict, Verdict::identified);
}

TEST(FitMudAOedometer, WithIvGivenLeavesNoise) {
  ASSERT_EQ(mud_a().material.I_v(), 0.03);
  const auto answer = fit(datasets::Gauge::crs_rate, {e100, lambda, kappa, D_r, C_1});
  ASSERT_TRUE(answer) << answer.error().message;
  expect_noise_is_left(*answer);
  expect_errors_and_verdicts(answer->result);
  expect_optimisers_agree(answer->result);
  EXPECT_EQ(answer->result.estimates[static_cast<std::size_t>(I_v)].verdict, Verdict::fixed);
}

// (e100, D_r) enter only through D_r (1+e100)^(-1/(lambda I_v))
TEST(FitMudAOedometer, PredictionsDoNotSeeTheGauge) {
  const model::Parameters<double>& start = mud_a().material;
  for (const double f : {1e-3, 0.3, 20.0}) {
    model::ParameterValues<double> moved = start.values();
    moved[D_r] *= f;
    moved[e100] = (1.0 + start.e100()) * std::pow(f, start.lambda() * start.I_v()) - 1.0;
    for (const auto& test : mud_a().oedometer_tests) {
      const experiments::OedometerExperiment experiment(test);
      const auto before = experiment.predict(start, {});
      const auto after = experiment.predict(*model::Parameters<double>::create(moved), {});
      ASSERT_TRUE(before && after);
      for (std::size_t i = 0; i < before->size(); ++i) {
        ASSERT_NEAR((*after)[i], (*before)[i], 3e-5) << test.name << ", value " << i << ", f = " << f;
      }
    }
  }
}

// along the orbit of the gauge d ln(1+e100) = lambda I_v d ln D_r, all else fixed
TEST(FitMudAOedometer, WithoutAGaugeTheNullDirectionIsThatOfTheIdentity) {
  const auto answer = fit(datasets::Gauge::none, {e100, lambda, kappa, D_r});
  ASSERT_TRUE(answer) << answer.error().message;
  const FitResult& result = answer->result;
  ASSERT_EQ(result.uncertainty.null_directions.size(), 1);
  ASSERT_EQ(result.free, (std::vector{e100, lambda, kappa, D_r}));
  const model::Parameters<double>& at = *result.parameters;
  Eigen::Vector4d expected((1.0 + at.e100()) / at.e100() * at.lambda() * at.I_v(), 0.0, 0.0, 1.0);
  expected.normalize();
  Eigen::Vector4d found = result.uncertainty.null_directions[0];
  if (found[3] < 0.0) found = -found;
  EXPECT_LT((found - expected).norm(), 1e-6) << found.transpose() << " instead of " << expected.transpose();
  for (const model::ParameterId id : {e100, D_r}) {
    EXPECT_EQ(result.estimates[static_cast<std::size_t>(id)].verdict, Verdict::undetermined);
  }
  EXPECT_EQ(result.estimates[static_cast<std::size_t>(lambda)].verdict, Verdict::identified);
}

// Central differences of steps h and h/2, extrapolated; what is left is the integrator's tolerance over the
// step.
TEST(FitMudAOedometer, JetsThroughTheWholePredictionAreItsDerivatives) {
  // with an ellipse that rotates, so that every parameter acts
  auto rotating = mud_a().material.values();
  rotating[model::ParameterId::C_2] = 20.0;
  rotating[model::ParameterId::C_3] = 0.3;
  const auto at = model::Parameters<double>::create(rotating).value();
  std::vector<model::ParameterId> all;
  for (const auto& parameter : model::kParameterTable) all.push_back(parameter.id);
  constexpr auto kCount = static_cast<Eigen::Index>(model::kParameterCount);
  for (const auto& test : mud_a().oedometer_tests) {
    const experiments::OedometerExperiment experiment(test);
    const auto exact = experiment.linearise(at, {}, Eigen::MatrixXd::Identity(kCount, kCount));
    ASSERT_TRUE(exact);
    const auto slope = [&](model::ParameterId id, double relative) {
      model::ParameterValues<double> low = at.values();
      model::ParameterValues<double> high = at.values();
      low[id] *= 1.0 - relative;
      high[id] *= 1.0 + relative;
      const auto below = experiment.predict(*model::Parameters<double>::create(low), {});
      const auto above = experiment.predict(*model::Parameters<double>::create(high), {});
      EXPECT_TRUE(below && above);
      return ((Eigen::Map<const Eigen::VectorXd>(above->data(), exact->jacobian.rows()) -
               Eigen::Map<const Eigen::VectorXd>(below->data(), exact->jacobian.rows())) /
              (2.0 * relative))
          .eval();
    };
    for (std::size_t k = 0; k < all.size(); ++k) {
      constexpr double kStep = 4e-3;
      const Eigen::VectorXd differences = (4.0 * slope(all[k], 0.5 * kStep) - slope(all[k], kStep)) / 3.0;
      const Eigen::VectorXd jets = at[all[k]] * exact->jacobian.col(static_cast<Eigen::Index>(k));
      const double largest = jets.lpNorm<Eigen::Infinity>();
      EXPECT_GT(largest, 0.0);
      EXPECT_LT((jets - differences).lpNorm<Eigen::Infinity>(), 1e-3 * largest)
          << test.name << ": " << model::info(all[k]).name;
    }
  }
}

}  // namespace
}  // namespace isotach::calibration
