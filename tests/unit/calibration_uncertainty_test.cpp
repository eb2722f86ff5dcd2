// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Covariances in closed form: a straight line through seven values, t = -3 .. 3, sum of t^2 28.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calibration/uncertainty.hpp"
#include "tests/unit/calibration_line_experiment.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;
using tests::line;
using tests::LineExperiment;
using tests::problem_of;

const std::vector<double> kAnswer{tests::kIntercept, tests::kSlope};
constexpr double kNoise2 = tests::kNoise * tests::kNoise;

const ParameterEstimate& estimate_of(const std::vector<ParameterEstimate>& all, model::ParameterId id) {
  return all[static_cast<std::size_t>(id)];
}

TEST(Uncertainty, CovarianceIsTheInverseOfJtJ) {
  const auto uncertainty =
      estimate_uncertainty(problem_of({line(0.1)}, {e100, lambda}), kAnswer, Correlation::independent);
  ASSERT_TRUE(uncertainty.has_value());
  EXPECT_NEAR(uncertainty->covariance(0, 0), kNoise2 / 7.0, 1e-12 * kNoise2);
  EXPECT_NEAR(uncertainty->covariance(1, 1), kNoise2 / 28.0, 1e-12 * kNoise2);
  EXPECT_NEAR(uncertainty->covariance(0, 1), 0.0, 1e-12 * kNoise2);
  EXPECT_EQ(uncertainty->inflation,
            1.0);  // the misfit, chi^2 84/100 of 5 degrees of freedom, is below the noise
  EXPECT_TRUE(uncertainty->null_directions.empty());
}

TEST(Uncertainty, GrowsWithMisfitBeyondTheNoise) {
  const auto uncertainty =
      estimate_uncertainty(problem_of({line(1.0)}, {e100, lambda}), kAnswer, Correlation::independent);
  ASSERT_TRUE(uncertainty.has_value());
  EXPECT_NEAR(uncertainty->inflation, std::sqrt(84.0 / 5.0), 1e-9);  // chi^2/(7 - 2)
  EXPECT_NEAR(uncertainty->covariance(0, 0), 84.0 / 5.0 * kNoise2 / 7.0, 1e-9 * kNoise2);
}

// Neighbours' products sum to 24 and squares to 84: rho = 2/7, (1 + rho)/(1 - rho) = 9/5. Two tests have the
// same rho, as no product reaches from one into the next (5 times 5 would make it 73/168).
TEST(Uncertainty, GrowsWithSerialCorrelationWithinTests) {
  for (const std::size_t tests : {1U, 2U}) {
    const std::vector<LineExperiment> lines(tests, line(0.1));
    const auto uncertainty =
        estimate_uncertainty(problem_of(lines, {e100, lambda}), kAnswer, Correlation::serial);
    ASSERT_TRUE(uncertainty.has_value());
    EXPECT_NEAR(uncertainty->autocorrelation, 2.0 / 7.0, 1e-9);
    EXPECT_NEAR(uncertainty->inflation, std::sqrt(9.0 / 5.0), 1e-9);
    EXPECT_NEAR(uncertainty->covariance(1, 1), 9.0 / 5.0 * kNoise2 / 28.0 / static_cast<double>(tests),
                1e-9 * kNoise2);
  }
}

TEST(Uncertainty, AlternatingResidualsDoNotMakeItSmaller) {
  experiments::Values measured;
  for (int t = -3; t <= 3; ++t) measured.push_back((t % 2 == 0 ? 0.5 : -0.5) * tests::kNoise);
  const LineExperiment zigzag({{e100, tests::constant_term}}, measured, tests::kNoise);
  const auto uncertainty = estimate_uncertainty(problem_of({zigzag}, {e100}), {0.0}, Correlation::serial);
  ASSERT_TRUE(uncertainty.has_value());
  EXPECT_EQ(uncertainty->autocorrelation, 0.0);
  EXPECT_EQ(uncertainty->inflation, 1.0);
}

// e100 and kappa enter as ln e100 + 2 ln kappa: the data see (1, 2)/sqrt5 and not (2, -1)/sqrt5.
TEST(Uncertainty, RedundantPairHasANullDirection) {
  const LineExperiment redundant(
      {{e100, tests::constant_term}, {kappa, [](double) { return 2.0; }}, {lambda, tests::linear_term}},
      experiments::Values(7, 0.0), tests::kNoise);
  const std::vector<double> x{0.3, std::log(0.01), -2.0};
  const Problem problem = problem_of({redundant}, {e100, kappa, lambda});
  const auto uncertainty = estimate_uncertainty(problem, x, Correlation::independent);
  ASSERT_TRUE(uncertainty.has_value());
  ASSERT_EQ(uncertainty->null_directions.size(), 1U);
  Eigen::VectorXd direction = uncertainty->null_directions.front();
  if (direction[0] < 0.0) direction = -direction;
  EXPECT_NEAR(direction[0], 2.0 / std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(direction[1], -1.0 / std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(direction[2], 0.0, 1e-9);

  Uncertainty without_misfit = *uncertainty;
  without_misfit.covariance(2, 2) = kNoise2 / 28.0;
  const auto estimates = estimate_parameters(problem, x, without_misfit);
  EXPECT_EQ(estimate_of(estimates, e100).verdict, Verdict::undetermined);
  EXPECT_EQ(estimate_of(estimates, kappa).verdict, Verdict::undetermined);
  EXPECT_EQ(estimate_of(estimates, lambda).verdict, Verdict::identified);
}

// one value for two coordinates: ln e100 + t ln lambda at t = 0 sees e100 alone
TEST(Uncertainty, FewerValuesThanCoordinatesLeaveDirectionsUnseen) {
  const LineExperiment one({{e100, tests::constant_term}, {lambda, tests::linear_term}},
                           experiments::Values{tests::kIntercept}, tests::kNoise);
  const auto uncertainty =
      estimate_uncertainty(problem_of({one}, {e100, lambda}), kAnswer, Correlation::whitened);
  ASSERT_TRUE(uncertainty.has_value());
  ASSERT_EQ(uncertainty->null_directions.size(), 1U);
  EXPECT_NEAR(std::abs(uncertainty->null_directions[0][1]), 1.0, 1e-12);
  EXPECT_NEAR(uncertainty->covariance(0, 0), kNoise2, 1e-9 * kNoise2);
  EXPECT_FALSE(uncertainty->in_null_direction(0));
  EXPECT_TRUE(uncertainty->in_null_direction(1));
}

TEST(Estimates, IntervalOfALogarithmicCoordinateIsThatOfItsExponential) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const auto uncertainty = estimate_uncertainty(problem, kAnswer, Correlation::independent);
  const auto estimates = estimate_parameters(problem, kAnswer, *uncertainty);
  ASSERT_EQ(estimates.size(), model::kParameterCount);
  const ParameterEstimate& got = estimate_of(estimates, lambda);
  const double error = tests::kNoise / std::sqrt(28.0);
  EXPECT_NEAR(got.value, std::exp(-2.0), 1e-15);
  EXPECT_NEAR(got.std_error, std::exp(-2.0) * error, 1e-12);
  EXPECT_NEAR(got.ci95_lower, std::exp(-2.0 - 1.959964 * error), 1e-9);
  EXPECT_NEAR(got.ci95_upper, std::exp(-2.0 + 1.959964 * error), 1e-9);
}

TEST(Estimates, ParametersThatDidNotMoveAreFixedAndHaveNoError) {
  const Problem problem = problem_of({line(0.1)}, {e100, lambda});
  const auto estimates = estimate_parameters(
      problem, kAnswer, *estimate_uncertainty(problem, kAnswer, Correlation::independent));
  for (const model::ParameterId id : {kappa, I_v, D_r, phi_c, C_1}) {
    EXPECT_EQ(estimate_of(estimates, id).verdict, Verdict::fixed);
    EXPECT_EQ(estimate_of(estimates, id).value, tests::seed_mud()[id]);
    EXPECT_TRUE(std::isnan(estimate_of(estimates, id).std_error));
  }
}

Uncertainty of_one(double standard_error) {
  Uncertainty uncertainty;
  uncertainty.covariance = Eigen::MatrixXd::Constant(1, 1, standard_error * standard_error);
  return uncertainty;
}

// The half width of exp(x +- 1.96 s) relative to exp(x) is sinh(1.96 s): a quarter at s = 0.12626, one at
// s = 0.44969.
TEST(Verdicts, OfALogarithmicParameterTurnAtAQuarterAndAtOne) {
  const Problem problem = problem_of({line(0.1)}, {e100});
  const auto verdict = [&](double standard_error) {
    return estimate_of(estimate_parameters(problem, {0.3}, of_one(standard_error)), e100).verdict;
  };
  EXPECT_EQ(verdict(0.01), Verdict::identified);
  EXPECT_EQ(verdict(0.1262), Verdict::identified);
  EXPECT_EQ(verdict(0.1263), Verdict::weak);
  EXPECT_EQ(verdict(0.4496), Verdict::weak);
  EXPECT_EQ(verdict(0.4498), Verdict::undetermined);
  EXPECT_EQ(verdict(std::numeric_limits<double>::infinity()), Verdict::undetermined);
}

TEST(Verdicts, ParameterAtItsBoundIsWeakAtBest) {
  const Problem problem = problem_of({line(0.1)}, {e100});
  const double at_bound = problem.parametrisation().lower()[0];
  const auto estimates = estimate_parameters(problem, {at_bound}, of_one(0.01));
  EXPECT_EQ(estimate_of(estimates, e100).verdict, Verdict::weak);
  EXPECT_NEAR(estimate_of(estimates, e100).ci95_lower, default_bounds(e100).lower, 1e-12);
}

// C_1 may be anything up to 1 - 0.0129/0.154 = 0.91623: judged against 0.4 of that, 0.36649. Its interval
// ends at zero.
TEST(Verdicts, OfC1AreJudgedAgainstItsRange) {
  const Problem problem = problem_of({line(0.1)}, {C_1});
  const auto estimate = [&](double standard_error) {
    return estimate_of(estimate_parameters(problem, {0.3}, of_one(standard_error)), C_1);
  };
  EXPECT_EQ(estimate(0.0467).verdict, Verdict::identified);  // 1.96 s = 0.0915 < 0.0916
  EXPECT_EQ(estimate(0.0468).verdict, Verdict::weak);        // 0.0917
  EXPECT_EQ(estimate(0.5).ci95_lower, 0.0);
  EXPECT_NEAR(estimate(0.01).std_error, 0.01, 1e-15);
}

// D_r = f(lambda): its error is |dD_r/dlambda| lambda s, and its verdict says that it was not fitted.
TEST(Verdicts, GaugedDrCarriesTheErrorOfWhatItFollows) {
  const Experiments experiments{std::make_shared<LineExperiment>(line(0.1))};
  const GaugeChoice gauge{datasets::Gauge::crs_rate, 7e-7};
  const Parametrisation parametrisation(tests::seed_mud(), {lambda, D_r}, {}, gauge);
  const Problem problem(experiments, parametrisation, 1);
  const std::vector<double> x{std::log(0.154)};
  const ParameterEstimate got = estimate_of(estimate_parameters(problem, x, of_one(0.05)), D_r);
  EXPECT_EQ(got.verdict, Verdict::gauge);
  constexpr double kStep = 1e-5;
  const double slope = (parametrisation.at(std::vector<double>{x[0] + kStep})->D_r() -
                        parametrisation.at(std::vector<double>{x[0] - kStep})->D_r()) /
                       (2.0 * kStep);
  EXPECT_GT(std::abs(slope), 0.0);
  EXPECT_NEAR(got.std_error / (0.05 * std::abs(slope)), 1.0, 1e-6);
}

TEST(Correlations, AreCovariancesOverTheRootsOfVariances) {
  Eigen::MatrixXd covariance(2, 2);
  covariance << 4.0, -3.0, -3.0, 9.0;
  const Eigen::MatrixXd correlation = correlation_of(covariance);
  EXPECT_DOUBLE_EQ(correlation(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(correlation(0, 1), -0.5);
}

TEST(Summaries, GiveTheRmsPlainAndInNoise) {
  const Experiments experiments{std::make_shared<LineExperiment>(line(1.0)),
                                std::make_shared<LineExperiment>(line(1.0).hold_out())};
  const auto exact =
      Parametrisation(tests::seed_mud(), {e100, lambda}, {}, {}).at(std::vector<double>(kAnswer));
  const auto evaluation = evaluate_all(experiments, *exact, {}, 2);
  ASSERT_TRUE(evaluation.has_value());
  const auto tests = summarise_tests(experiments, *evaluation);
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_FALSE(tests[0].held_out);
  EXPECT_TRUE(tests[1].held_out);
  EXPECT_EQ(tests[0].values, 7U);
  EXPECT_NEAR(tests[0].rms_over_noise, std::sqrt(12.0), 1e-9);  // 84/7
  EXPECT_NEAR(tests[0].rms, 0.01 * std::sqrt(12.0), 1e-11);
}

}  // namespace
}  // namespace isotach::calibration
