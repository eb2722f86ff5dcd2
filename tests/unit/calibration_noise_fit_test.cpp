// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Noise of a problem's channels, weights, priors, other starts, global searches and the bootstrap, on
// straight lines with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/bootstrap.hpp"
#include "calibration/multi_start.hpp"
#include "calibration/noise_fit.hpp"
#include "calibration/uncertainty.hpp"
#include "tests/unit/calibration_line_experiment.hpp"

namespace isotach::calibration {
namespace {

using enum model::ParameterId;
using tests::LineExperiment;
using tests::problem_of;

/// A line of many values with noise of `level` and autocorrelation rho.
LineExperiment noisy_line(std::size_t count, double level, double rho, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  experiments::Values measured;
  double error = normal(random);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) - 0.5 * static_cast<double>(count - 1);
    measured.push_back(tests::kIntercept + tests::kSlope * t + level * error);
    error = rho * error + std::sqrt(1.0 - rho * rho) * normal(random);
  }
  return LineExperiment({{e100, tests::constant_term}, {lambda, tests::linear_term}}, measured,
                        tests::kNoise);
}

const std::vector<double> kAnswer{tests::kIntercept, tests::kSlope};

// standard error of a level from n values is 1/sqrt(2n), of rho sqrt((1 - rho^2)/n): four of them
TEST(NoiseFit, FindsLevelAndAutocorrelation) {
  constexpr std::size_t kCount = 2000;
  for (const double rho : {0.0, 0.6}) {
    const Problem problem = problem_of({noisy_line(kCount, 0.03, rho, 3)}, {e100, lambda});
    const auto fit = fit_noise(problem, kAnswer);
    ASSERT_TRUE(fit);
    ASSERT_EQ(fit->channels.size(), 1U);
    const ChannelNoise& noise = fit->channels[0];
    EXPECT_TRUE(noise.estimated);
    EXPECT_EQ(noise.stated_level, tests::kNoise);
    const double stretch = std::sqrt((1.0 + rho * rho) / (1.0 - rho * rho));
    EXPECT_NEAR(noise.model.level, 0.03, 4.0 * stretch * 0.03 / std::sqrt(2.0 * kCount));
    EXPECT_NEAR(noise.model.rho, rho, 4.0 * std::sqrt((1.0 - rho * rho) / kCount));
    const double expected =
        static_cast<double>(kCount) * (1.0 - noise.model.rho) / (1.0 + noise.model.rho) - 2.0;
    EXPECT_NEAR(fit->degrees, expected, 3.0);
  }
}

// Whitened, the intercept's variance is level^2/n (1 + rho)/(1 - rho), but for ends of the series
TEST(NoiseFit, WeightsMakeTheCovarianceThatOfTheNoise) {
  constexpr std::size_t kCount = 2000;
  Problem problem = problem_of({noisy_line(kCount, 0.03, 0.6, 3)}, {e100, lambda});
  const auto fit = fit_noise(problem, kAnswer);
  ASSERT_TRUE(fit);
  problem.set_weights(fit->weights);
  const auto uncertainty = estimate_uncertainty(problem, kAnswer, Correlation::whitened);
  ASSERT_TRUE(uncertainty);
  const double rho = fit->channels[0].model.rho;
  const double level = fit->channels[0].model.level;
  EXPECT_NEAR(uncertainty->covariance(0, 0) / (level * level / kCount * (1.0 + rho) / (1.0 - rho)), 1.0,
              0.01);
  const auto white = problem.residuals(kAnswer);
  EXPECT_NEAR(white->squaredNorm() / kCount, 1.0, 0.05);
}

// Shared by two tests, the level scatters by half as much in variance as each test's own; over 40 draws the
// ratio of variances is known to a quarter or so.
TEST(NoiseFit, OfTestsOfOneApparatusIsThatOfAll) {
  constexpr std::size_t kCount = 200;
  constexpr unsigned kDraws = 40;
  double own = 0.0;
  double shared = 0.0;
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    const Problem problem =
        problem_of({noisy_line(kCount, 0.03, 0.6, 2 * draw), noisy_line(kCount, 0.03, 0.6, 2 * draw + 1)},
                   {e100, lambda});
    const auto apart = fit_noise(problem, kAnswer);
    const auto together = fit_noise(problem, kAnswer, {NoiseParts::lasting, true});
    ASSERT_TRUE(apart && together);
    ASSERT_EQ(together->channels.size(), 2U);
    EXPECT_EQ(together->channels[0].model.level, together->channels[1].model.level);
    EXPECT_EQ(together->channels[0].model.rho, together->channels[1].model.rho);
    own += std::pow(apart->channels[0].model.level - 0.03, 2);
    shared += std::pow(together->channels[0].model.level - 0.03, 2);
    // what two chains hold, each of it
    EXPECT_NEAR(together->channels[0].model.effective_count, together->channels[1].model.effective_count,
                1e-9);
    EXPECT_LT(together->channels[0].model.effective_count, 0.5 * kCount);
  }
  EXPECT_GT(own / shared, 1.3);
  EXPECT_LT(own / shared, 3.0);
}

TEST(NoiseFit, OfTestsThatScatterDifferentlyIsTheirOwn) {
  constexpr std::size_t kCount = 200;
  const Problem problem =
      problem_of({noisy_line(kCount, 0.03, 0.6, 1), noisy_line(kCount, 0.06, 0.6, 2)}, {e100, lambda});
  const auto apart = fit_noise(problem, kAnswer);
  const auto together = fit_noise(problem, kAnswer, {NoiseParts::lasting, true});
  ASSERT_TRUE(apart && together);
  for (std::size_t k : {0U, 1U}) {
    EXPECT_EQ(together->channels[k].model.level, apart->channels[k].model.level);
    EXPECT_EQ(together->channels[k].model.rho, apart->channels[k].model.rho);
  }
}

TEST(NoiseFit, TooFewValuesKeepTheNoiseStated) {
  const Problem problem = problem_of({noisy_line(9, 0.03, 0.0, 3)}, {e100, lambda});
  const auto fit = fit_noise(problem, kAnswer);
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->channels[0].estimated);
  EXPECT_EQ(fit->channels[0].model.level, tests::kNoise);
  EXPECT_GE(fit->degrees, 3.0);
}

// Seven values of noise 0.01 and a prior of ln e100 = 0.5 +- 0.01/sqrt(7): halfway between
TEST(Priors, CountAsOneMoreDatum) {
  CoordinateSettings settings;
  const double error = tests::kNoise / std::sqrt(7.0);
  settings.priors[static_cast<std::size_t>(e100)] = datasets::Prior{std::exp(0.5), error * std::exp(0.5)};
  const Problem problem({std::make_shared<LineExperiment>(tests::line(0.0))},
                        Parametrisation(tests::seed_mud(), {e100, lambda}, settings, {}), 1);
  EXPECT_EQ(problem.residual_count(), 8U);
  const OptimiserResult found = minimise_with_ceres(problem, kAnswer, {}, {});
  EXPECT_NEAR(found.coordinates[0], 0.4, 1e-8);
  const auto uncertainty = estimate_uncertainty(problem, found.coordinates, Correlation::whitened);
  EXPECT_NEAR(std::sqrt(uncertainty->covariance(0, 0)), error / std::sqrt(2.0), 1e-9);
}

TEST(MultiStart, FindsOneAnswerOfALine) {
  const Problem problem = problem_of({tests::line(0.1)}, {e100, lambda});
  const auto at = problem.linearise(kAnswer);
  const MultiStart found =
      multi_start(problem, kAnswer, at->jacobian.transpose() * at->jacobian, {.starts = 9, .threads = 2}, {});
  EXPECT_EQ(found.failed, 0);
  ASSERT_EQ(found.clusters.size(), 1U);
  EXPECT_EQ(found.clusters[0].count, 9U);
  EXPECT_NEAR(found.clusters[0].best[0], tests::kIntercept, 1e-6);
  EXPECT_EQ(found.from.size(), 9U);
  EXPECT_NE(found.from[0], found.from[1]);
}

/// Predicts (ln lambda)^2, so that lambda and 1/lambda serve alike.
class Square final : public experiments::Experiment {
 public:
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] bool held_out() const override { return false; }
  [[nodiscard]] const experiments::Values& measured() const override { return measured_; }
  [[nodiscard]] std::string_view quantity() const override { return "square (-)"; }
  [[nodiscard]] const experiments::Values& noise() const override { return noise_; }
  [[nodiscard]] tl::expected<experiments::Values, experiments::PredictionFailure> predict(
      const model::Parameters<double>& parameters, std::span<const double>) const override {
    const double x = std::log(parameters.e100());
    return experiments::Values{x * x};
  }

 private:
  std::string name_ = "square";
  experiments::Values measured_{0.16};
  experiments::Values noise_{0.01};
};

TEST(MultiStart, TellsTwoAnswersApart) {
  const Problem problem({std::make_shared<Square>()}, Parametrisation(tests::seed_mud(), {e100}, {}, {}), 1);
  const Eigen::MatrixXd information = Eigen::MatrixXd::Constant(1, 1, 0.64 / 1e-4);  // (2 ln e100/0.01)^2
  const MultiStart found = multi_start(problem, {0.05}, information, {.starts = 16}, {});
  ASSERT_EQ(found.clusters.size(), 2U);
  EXPECT_NEAR(std::abs(found.clusters[0].best[0]), 0.4, 1e-3);
  EXPECT_NEAR(found.clusters[0].best[0], -found.clusters[1].best[0], 1e-3);
  EXPECT_EQ(found.clusters[0].count + found.clusters[1].count, 16U);
}

TEST(GlobalSearches, AllFindTheLine) {
  const Problem problem = problem_of({tests::line(0.1)}, {e100, lambda});
  GlobalOptions options;
  options.lower = {-1.0, -3.0};
  options.upper = {1.0, -1.0};
  for (const GlobalSearch search :
       {GlobalSearch::crs2, GlobalSearch::isres, GlobalSearch::esch, GlobalSearch::mlsl}) {
    const OptimiserResult found = search_globally(problem, search, {-0.8, -1.2}, options, {});
    EXPECT_NEAR(found.coordinates[0], tests::kIntercept, 1e-4) << name_of(search);
    EXPECT_NEAR(found.coordinates[1], tests::kSlope, 1e-4) << name_of(search);
    EXPECT_NE(found.route.find(name_of(search)), std::string::npos);
    EXPECT_TRUE(found.converged) << found.termination;
  }
}

// spread of the intercept 0.03/sqrt(n) in theory; 400 samples tell a spread to 3.5 %, ten of them allowed
TEST(Bootstrap, SpreadsAsTheStandardErrorDoes) {
  constexpr std::size_t kCount = 200;
  Problem problem = problem_of({noisy_line(kCount, 0.03, 0.0, 11)}, {e100, lambda});
  const OptimiserResult answer = minimise_with_ceres(problem, kAnswer, {}, {});
  const auto noise = fit_noise(problem, answer.coordinates);
  ASSERT_TRUE(noise);
  problem.set_weights(noise->weights);
  const Bootstrap found = bootstrap(problem, *noise, answer.coordinates, {.samples = 400, .threads = 2}, {});
  EXPECT_EQ(found.failed, 0);
  const double error = noise->channels[0].model.level / std::sqrt(static_cast<double>(kCount));
  EXPECT_NEAR(found.std_error[0] / error, 1.0, 0.2);
  EXPECT_NEAR(found.mean[0], answer.coordinates[0], 0.3 * error);
  EXPECT_NEAR((found.upper[0] - found.lower[0]) / (3.92 * error), 1.0, 0.25);
  const Bootstrap again = bootstrap(problem, *noise, answer.coordinates, {.samples = 400, .threads = 1}, {});
  EXPECT_EQ(found.std_error, again.std_error) << "samples do not depend on the number of threads";
}

}  // namespace
}  // namespace isotach::calibration
