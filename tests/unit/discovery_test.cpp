// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Discovery on readings made from the protocols of mud-a: nothing hidden, and an effect hidden. Generator and
// fitter are the same code here; how often names are right is another question.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/distributions.hpp"
#include "discovery/discover.hpp"
#include "discovery/left_out.hpp"
#include "discovery/limits.hpp"
#include "discovery/meets_noise.hpp"
#include "discovery/oedometer_wandering.hpp"

namespace isotach::discovery {
namespace {

/// The oedometer tests of mud-a with stresses that the model gives, with `effects`, and independent noise of
/// the size that the study states.
datasets::Study hidden(const effects::Values<double>& effects, unsigned seed = 7) {
  datasets::Study study =
      datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
  study.slump_tests.clear();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (datasets::OedometerTest& test : study.oedometer_tests) {
    const experiments::OedometerExperiment experiment(test, effects, {});
    const auto predicted = experiment.predict(study.material, experiment.local_values());
    if (!predicted) throw std::runtime_error(predicted.error().message);
    for (std::size_t i = 0; i < predicted->size(); ++i) {
      const experiments::ComparedValue& value = experiment.values()[i];
      test.record.rows[value.row].axial_stress =
          std::exp((*predicted)[i] + experiment.noise()[i] * normal(random));
    }
  }
  return study;
}

calibration::OedometerFitOptions quick() {
  calibration::OedometerFitOptions options;
  options.threads = 2;
  options.depth = calibration::Depth::answer;
  return options;
}

Discovery discovered(const datasets::Study& study) {
  auto found = discover_oedometer(study, {.threads = 2, .control = {}, .without = {}, .progress = {}});
  if (!found) throw std::runtime_error(found.error().message);
  return std::move(*found);
}

TEST(Discovery, ModelThatMadeTheDataSuffices) {
  const Discovery found = discovered(hidden({}));
  EXPECT_EQ(found.verdict, Verdict::adequate);
  EXPECT_GT(found.p_value, 0.002);
  EXPECT_NEAR(found.base.gap.fitted, 1.0, 0.1);
  EXPECT_NEAR(found.smoother, 1.08, 0.1) << "sqrt(1 + 1/6) of independent noise";
  EXPECT_FALSE(found.chosen);
}

TEST(Discovery, HiddenRingFrictionIsNamed) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  constexpr double kFriction = 0.1;
  const Discovery found =
      discovered(hidden(*effects::Values<double>::create({effects::with_amplitude(friction, kFriction)})));
  ASSERT_EQ(found.verdict, Verdict::named) << name_of(found.verdict);
  const Trial& named = found.trials[*found.chosen];
  ASSERT_EQ(named.candidate.added.size(), 1U);
  EXPECT_EQ(named.candidate.added.front()->name, "ring_friction");
  EXPECT_NEAR((named.candidate.fit.effects[effects::ParameterRef{&friction, 0}]), kFriction, 0.2 * kFriction);
  EXPECT_GT(found.base.gap.fitted, 1.3);
  EXPECT_NEAR(named.gap.fitted, 1.0, 0.1);
  EXPECT_LT(named.gap.held_out, found.base.gap.held_out);
  EXPECT_NEAR(named.gap.held_out, 1.0, 0.2);
  EXPECT_GE(found.best_wrong, named.gap.fitted);
  ASSERT_EQ(found.amplitudes.size(), 1U);
  const AmplitudeInterval& interval = found.amplitudes.front();
  EXPECT_EQ(interval.effect, &friction);
  EXPECT_EQ(interval.value, (named.candidate.fit.effects[effects::ParameterRef{&friction, 0}]));
  EXPECT_LT(interval.lower, kFriction);
  EXPECT_GT(interval.upper, kFriction);
  EXPECT_EQ(interval.lower_end, calibration::ProfileEnd::crossed);
  EXPECT_EQ(interval.upper_end, calibration::ProfileEnd::crossed);
}

// Readings are nearly linear in the friction: there the profile's interval is that of the standard error.
TEST(AmplitudeInterval, OfAnAmplitudeThatActsLinearlyIsThatOfItsStandardError) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(friction, 0.1)}));
  const auto candidate = fit_with(study, study.material, {&friction}, quick());
  ASSERT_TRUE(candidate.has_value()) << candidate.error().message;
  const calibration::LocalEstimate& linear = candidate->fit.result.local_estimates.back();
  ASSERT_EQ(linear.effect->effect, &friction);
  for (const double level : {0.68, 0.95}) {
    const auto intervals = amplitude_intervals(study, *candidate, level, 2, {});
    ASSERT_EQ(intervals.size(), 1U);
    const double half =
        linear.std_error *
        calibration::student_t_quantile(0.5 * (1.0 + level), candidate->fit.result.uncertainty.degrees);
    EXPECT_NEAR(intervals[0].lower, linear.value - half, 0.03 * half) << level;
    EXPECT_NEAR(intervals[0].upper, linear.value + half, 0.03 * half) << level;
  }
}

// Amplitude and decay of a structure trade off: the misfit of a smaller one grows faster than that of a
// larger one, and both ends of the interval meet the data as badly.
TEST(AmplitudeInterval, EndsWhereTheDataAreMetAsBadlyOnBothSides) {
  const effects::Effect& structure = *effects::find_effect("structure");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(structure, 0.3)}));
  const auto candidate = fit_with(study, study.material, {&structure}, quick());
  ASSERT_TRUE(candidate.has_value()) << candidate.error().message;
  const auto intervals = amplitude_intervals(study, *candidate, 0.95, 2, {});
  ASSERT_EQ(intervals.size(), 1U);
  const auto chi_squared_at = [&](double amplitude) {
    const calibration::Problem problem = calibration::problem_of(study, candidate->fit, candidate->free, 2);
    const auto& coordinates = problem.parametrisation().coordinates();
    std::vector<double> x = candidate->fit.result.main.coordinates;
    calibration::CeresOptions options;
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      if (coordinates[k].effect != effects::ParameterRef{&structure, 0}) continue;
      x[k] = coordinates[k].of_quantity(amplitude);
      options.held = {k};
    }
    return 2.0 * calibration::minimise_with_ceres(problem, x, options, {}).cost;
  };
  const double least = chi_squared_at(intervals[0].value);
  const double t = calibration::student_t_quantile(0.975, candidate->fit.result.uncertainty.degrees);
  EXPECT_NEAR(chi_squared_at(intervals[0].lower) - least, t * t, 0.05 * t * t);
  EXPECT_NEAR(chi_squared_at(intervals[0].upper) - least, t * t, 0.05 * t * t);
}

/// Bounds of kappa that begin so many standard errors above what a fit with the effect finds.
datasets::Study with_kappa_above(datasets::Study study, const effects::Effect& effect, double errors) {
  const auto free = fit_with(study, study.material, {&effect}, quick());
  if (!free) throw std::runtime_error(free.error().message);
  const auto kappa = static_cast<std::size_t>(model::ParameterId::kappa);
  const calibration::ParameterEstimate& found = free->fit.result.estimates[kappa];
  study.fit.bounds[kappa] = datasets::Bounds{found.value + errors * found.std_error, 0.1};
  return study;
}

TEST(Discovery, NameThatNeedsAConstantAtItsBoundIsRefused) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(friction, 0.1)}));
  const Discovery found = discovered(with_kappa_above(study, friction, 4.0));
  EXPECT_NE(found.verdict, Verdict::named);
  EXPECT_EQ(name_of(found.trials.front().candidate), "ring_friction");
  bool said = false;
  for (const Condition& condition : found.conditions) {
    if (condition.text.find("held at a bound") == std::string::npos) continue;
    said = true;
    EXPECT_FALSE(condition.holds);
    EXPECT_NE(condition.text.find("kappa"), std::string::npos) << condition.text;
  }
  EXPECT_TRUE(said);
}

// To first order the gain of releasing a constant that ends n standard errors from its best is n^2.
TEST(Discovery, AConstantAtABoundThatDataDoNotPressAgainstIsNotNeededThere) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(friction, 0.1)}));
  for (const double errors : {1.0, 3.0}) {
    const datasets::Study bounded = with_kappa_above(study, friction, errors);
    const auto with = fit_with(bounded, bounded.material, {&friction}, quick());
    ASSERT_TRUE(with.has_value()) << with.error().message;
    const double lower = bounded.fit.bounds[static_cast<std::size_t>(model::ParameterId::kappa)]->lower;
    EXPECT_NEAR(with->fit.result.parameters->kappa(), lower, 1e-6 * lower);
    EXPECT_EQ(with->beyond_bounds,
              errors > 2.0 ? std::vector<std::string>{"kappa"} : std::vector<std::string>{});
  }
}

/// Whether the fitted tests of a study can be predicted with an effect at its typical amplitude.
bool typical_predicts(const datasets::Study& study, const effects::Effect& effect) {
  const auto on =
      effects::Values<double>::create({effects::with_amplitude(effect, effect.parameters[0].typical_si())});
  for (const datasets::OedometerTest& test : study.oedometer_tests) {
    const experiments::OedometerExperiment experiment(test, *on, {});
    if (!test.hold_out && !experiment.predict(study.material, experiment.local_values())) return false;
  }
  return true;
}

// Water that has 90 mm to go leaves so thick a specimen no stress at all, at the typical conductivity.
TEST(Discovery, EffectsWhoseTypicalAmplitudeIsTooMuchAreFittedFromLess) {
  const effects::Effect& water = *effects::find_effect("pore_pressure");
  datasets::Study study = hidden({});
  for (datasets::OedometerTest& test : study.oedometer_tests) test.height *= 4.0;
  ASSERT_FALSE(typical_predicts(study, water));
  const auto with = fit_with(study, study.material, {&water}, quick());
  ASSERT_TRUE(with.has_value()) << with.error().message;
  EXPECT_NEAR(gap_of(with->fit).fitted, 1.0, 0.1);
}

// A test held out, of which the answer leaves nothing, takes no name away: it only measures.
TEST(Discovery, TestsHeldOutThatCannotBePredictedAreLeftOut) {
  const effects::Effect& water = *effects::find_effect("pore_pressure");
  datasets::Study study = hidden(*effects::Values<double>::create(
      {effects::with_amplitude(water, 0.1 * water.parameters[0].typical_si())}));
  for (datasets::OedometerTest& test : study.oedometer_tests) test.height *= test.hold_out ? 40.0 : 1.0;
  const auto with = fit_with(study, study.material, {&water}, quick());
  ASSERT_TRUE(with.has_value()) << with.error().message;
  EXPECT_NEAR(gap_of(with->fit).fitted, 1.0, 0.1);
  EXPECT_TRUE(std::isnan(gap_of(with->fit).held_out));
}

TEST(Discovery, ScoresAreThoseOfLeastSquares) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(friction, 0.02)}));
  auto base = fit_with(study, study.material, {}, quick());
  ASSERT_TRUE(base.has_value()) << base.error().message;
  auto with = fit_with(study, study.material, {&friction}, quick());
  ASSERT_TRUE(with.has_value()) << with.error().message;
  // a weak effect: the gain of the full fit is the square of the score, by the same noise
  weigh_alike(study, {&*base, &*with}, 2);
  const auto scores = score(study, *base, {&friction}, with->fit.noise.weights, 2);
  ASSERT_TRUE(scores.has_value()) << scores.error().message;
  EXPECT_NEAR(std::sqrt(base->chi_squared - with->chi_squared) / std::sqrt(scores->best.front()), 1.0, 0.1);
  for (const Signature& signature : scores->signatures) {
    EXPECT_NEAR(signature.unit.norm(), 1.0, 1e-9);
    EXPECT_GT(signature.absorbed, 0.5) << "one ring, one direction at a time: most is taken up";
  }
}

/// The first of the slots that stand out over that variable.
const WanderingSlot& first_over(const Wandering& wandering, const WanderAxis& along) {
  return *std::find_if(wandering.slots.begin(), wandering.slots.end(),
                       [&along](const WanderingSlot& slot) { return slot.slot.along == &along; });
}

// An error of the load cell's zero is in no catalogue: a/sigma of the stress read, and nothing else.
// Knots that do the same, each by `shows` sigma, do so together: four of them by four times as much.
TEST(Wandering, CountsADirectionByItsLargestKnot) {
  const auto rank = [](double shows) {
    const Eigen::MatrixXd left = shows * Eigen::Vector3d(0.6, 0.0, 0.8) * Eigen::RowVector4d::Ones();
    return try_slot({"lambda", &kOverTime, true}, left, 0.1, Eigen::Vector3d::Zero()).basis.cols();
  };
  EXPECT_EQ(rank(1.01 * kWanderShows / 4.0), 1);
  EXPECT_EQ(rank(0.99 * kWanderShows / 4.0), 0);
}

TEST(Wandering, FindsTheReadingThatIsWrongAndHowWrong) {
  constexpr double kZero = 400.0;  // Pa
  datasets::Study study = hidden({});
  for (datasets::OedometerTest& test : study.oedometer_tests) {
    for (datasets::OedometerRow& row : test.record.rows) row.axial_stress += kZero;
  }
  const auto base = fit_with(study, study.material, {}, quick());
  ASSERT_TRUE(base.has_value()) << base.error().message;
  const auto found = let_wander(study, *base, base->fit.noise.weights, 2);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_LT(found->p_value, 0.002);
  const WanderingSlot& first = first_over(*found, kOverStress);
  EXPECT_EQ(first.slot.name, "stress_reading");
  ASSERT_EQ(first.curves.size(), 1U);
  EXPECT_EQ(first.curves.front().at.size(), kWanderKnots);
  // what it changes beyond the base's parameters is what the error does
  const auto linear =
      LinearModel::of(study, *base, base->fit.noise.weights, base->fit.result.main.coordinates, 2);
  ASSERT_TRUE(linear.has_value()) << linear.error().message;
  std::vector<experiments::Linearisation> error;
  for (const auto& experiment : base->fit.experiments) {
    if (experiment->held_out()) continue;
    const auto count = static_cast<Eigen::Index>(experiment->values().size());
    error.push_back({experiment->measured(), Eigen::MatrixXd(count, 1)});
    for (Eigen::Index i = 0; i < count; ++i) {
      const double stress =
          experiment->row_of(experiment->values()[static_cast<std::size_t>(i)]).axial_stress;
      error.back().jacobian(i, 0) = std::log(stress / (stress - kZero));
    }
  }
  const auto expected = linear->left_of(error, Eigen::VectorXd::Ones(1));
  double both = 0.0;
  double found2 = 0.0;
  double expected2 = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t k = 0; k < expected[i].size(); ++k) {
      both += expected[i][k] * first.change[i][k];
      found2 += std::pow(first.change[i][k], 2);
      expected2 += std::pow(expected[i][k], 2);
    }
  }
  EXPECT_GT(both / std::sqrt(found2 * expected2), 0.9);
  EXPECT_NEAR(std::sqrt(found2 / expected2), 1.0, 0.2);
}

// By its own noise a model that made the data is not improved: p is not small, for any of these noises.
TEST(Wandering, OfTheModelThatMadeTheDataStandsOutNoMoreThanNoise) {
  int small = 0;
  constexpr int kStudies = 12;
  for (unsigned seed = 1; seed <= kStudies; ++seed) {
    const datasets::Study study = hidden({}, seed);
    const auto base = fit_with(study, study.material, {}, quick());
    ASSERT_TRUE(base.has_value()) << base.error().message;
    const auto found = let_wander(study, *base, base->fit.noise.weights, 2);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    EXPECT_GT(found->p_value, 0.002) << seed;
    small += found->p_value < 0.25 ? 1 : 0;
  }
  EXPECT_GE(small, 1) << "p is uniform: none of twelve below a quarter has odds of 3 in 100";
  EXPECT_LE(small, 7) << "nor more than seven, of 0.3 in 100";
}

// The stage named first is the one where what the effect changes, freed of what the base can do, is largest.
TEST(Disagreement, IsRankedByWhatTheExplanationChanges) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(friction, 0.1)}));
  const auto base = fit_with(study, study.material, {}, quick());
  const auto with = fit_with(study, study.material, {&friction}, quick());
  ASSERT_TRUE(base.has_value() && with.has_value());
  std::vector<Disagreement> places = disagreement_of(base->fit);
  ASSERT_FALSE(rank_by_explanation(study, *base, *with, with->fit.noise.weights, 2, places));
  double total = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_EQ(places[k].explained.has_value(), !places[k].held_out);
    if (k > 0) {
      EXPECT_GE(places[k - 1].explained, places[k].explained);
    }
    if (places[k].explained) total += std::pow(*places[k].explained, 2);
  }
  // the friction is strong: residuals of the base are what it changes, and noise; but the base's fit weighed
  // by a noise of its own
  double squares = 0.0;
  for (const Disagreement& place : places) squares += place.held_out ? 0.0 : std::pow(place.score, 2);
  EXPECT_NEAR(total / squares, 1.0, 0.3);
}

TEST(Discovery, EffectsLeftOutAreNotTried) {
  const effects::Effect& friction = *effects::find_effect("ring_friction");
  const datasets::Study study =
      hidden(*effects::Values<double>::create({effects::with_amplitude(friction, 0.1)}));
  DiscoverOptions options;
  options.threads = 2;
  for (const effects::Effect* effect : effects::catalogue()) {
    if (effect->name != "sensor_drift") options.without.push_back(effect);
  }
  const auto found = discover_oedometer(study, options);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_EQ(found->verdict, Verdict::unknown);
  ASSERT_EQ(found->trials.size(), 1U);
  EXPECT_EQ(found->trials.front().candidate.added.front()->name, "sensor_drift");
}

/// ln of the normal density of whitened residuals r with derivatives J by coordinates of covariance C, but
/// for the constant: by the whole covariance of r.
double log_normal(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, const Eigen::MatrixXd& C) {
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(r.size(), r.size()) + J * C * J.transpose();
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  const Eigen::MatrixXd factor = root.matrixL();
  return -0.5 * root.matrixL().solve(r).squaredNorm() - factor.diagonal().array().log().sum();
}

// docs/discovery.md: two tests that cannot tell two effects apart, and the test that is asked for.
TEST(NextExperiment, PartsTheExplanationsAsItWasPredictedTo) {
  const auto folder = std::filesystem::path(ISOTACH_SOURCE_DIR) / "docs/discovery";
  const Discovery first = discovered(datasets::read_study(folder / "first.toml"));
  ASSERT_EQ(first.verdict, Verdict::ambiguous);
  ASSERT_TRUE(first.next);
  EXPECT_EQ(first.next->test, "fast");
  EXPECT_EQ(first.next->change, "followed by unloading and reloading by 2 % of strain");
  EXPECT_LT(first.next->now, 0.5 * first.next->separation);
  const Discovery second = discovered(datasets::read_study(folder / "second.toml"));
  ASSERT_EQ(second.verdict, Verdict::named);
  EXPECT_EQ(name_of(second.trials.front().candidate), "apparatus_compliance");
  const effects::Effect& frame = *effects::find_effect("apparatus_compliance");
  EXPECT_NEAR((second.trials.front().candidate.fit.effects[effects::ParameterRef{&frame, 0}]), 1.5e-9, 1e-10);
  // by how much chi-squared of the two comes apart: the square of the separation, with the spread of a
  // noncentral chi-squared
  const auto apart = [](const Discovery& found) {
    const auto of = [&](std::string_view name) {
      return std::find_if(found.trials.begin(), found.trials.end(),
                          [&](const Trial& trial) { return name_of(trial.candidate) == name; })
          ->candidate.chi_squared;
    };
    return of("gas") - of("apparatus_compliance");
  };
  const double gain = apart(second) - apart(first);
  const double separation = first.next->separation;
  EXPECT_NEAR(gain, separation * separation, 3.0 * 2.0 * separation);
}

TEST(LeftOut, IsTheDensityOfAPredictionWithItsUncertainty) {
  // e100, lambda, kappa alone: each test of mud-a holds them, and the model is nearly linear over their
  // errors
  datasets::Study study = hidden({});
  study.fit.oedometer = {model::ParameterId::e100, model::ParameterId::lambda, model::ParameterId::kappa};
  study.fit.gauge = datasets::Gauge::fixed;
  const auto base = fit_with(study, study.material, {}, quick());
  ASSERT_TRUE(base.has_value()) << base.error().message;
  const auto& weights = base->fit.noise.weights;
  const auto found = log_predictive_density(study, *base, weights, 2);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  ASSERT_EQ(weights.size(), 2U);

  double expected = 0.0;
  for (std::size_t out = 0; out < 2; ++out) {
    // both tests' whitened rows; those of the other one are the data, those of `out` the prediction
    calibration::Problem both = calibration::problem_of(study, base->fit, {}, 1);
    both.set_weights(weights);
    const auto first = static_cast<Eigen::Index>(both.fitted()[0]->measured().size());
    std::vector<double> x = base->fit.result.main.coordinates;
    Eigen::MatrixXd covariance;
    for (int step = 0; step < 4; ++step) {  // Gauss-Newton on the other test alone
      const auto at = both.linearise(x);
      ASSERT_TRUE(at.has_value());
      const Eigen::Index rest = at->residuals.size() - first;
      const Eigen::MatrixXd J = out == 0 ? at->jacobian.bottomRows(rest) : at->jacobian.topRows(first);
      const Eigen::VectorXd r = out == 0 ? at->residuals.tail(rest) : at->residuals.head(first);
      covariance = (J.transpose() * J).inverse();
      const Eigen::VectorXd move = covariance * (J.transpose() * r);
      for (std::size_t k = 0; k < x.size(); ++k) x[k] -= move[static_cast<Eigen::Index>(k)];
    }
    const auto at = both.linearise(x);
    ASSERT_TRUE(at.has_value());
    const Eigen::Index rest = at->residuals.size() - first;
    expected += out == 0 ? log_normal(at->residuals.head(first), at->jacobian.topRows(first), covariance)
                         : log_normal(at->residuals.tail(rest), at->jacobian.bottomRows(rest), covariance);
  }
  EXPECT_NEAR(*found, expected, 0.05) << "of " << expected;
}

TEST(MeetsNoise, EffectiveCountIsThatOfSeriesThatScatterAsMuch) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  constexpr int kSeries = 20000;
  constexpr int kCount = 60;
  for (const double share : {1.0, 0.5}) {
    for (const double rho : {0.0, 0.4, 0.7}) {
      double sum = 0.0;
      for (int s = 0; s < kSeries; ++s) {
        double value = normal(random);
        double squares = 0.0;
        for (int i = 0; i < kCount; ++i) {
          const double white = share < 1.0 ? std::sqrt(1.0 - share) * normal(random) : 0.0;
          squares += std::pow(std::sqrt(share) * value + white, 2);
          value = rho * value + std::sqrt(1.0 - rho * rho) * normal(random);
        }
        sum += std::pow(squares / kCount - 1.0, 2);
      }
      // the variance of the mean square of n independent values is 2/n
      const double expected = effective_count(kCount, squared_correlations(rho, share));
      EXPECT_NEAR(2.0 / (sum / kSeries) / expected, 1.0, 0.06) << rho << ' ' << share;
    }
  }
}

TEST(Probabilities, BelowWhatReplicatesTellAreSaidToBeBelow) {
  EXPECT_EQ(p_words(ScoreTest{{}, {}, {}, std::vector<double>(5000, 1.0)}.p_value(2.0)), "p < 0.0002");
  EXPECT_EQ(p_words(0.0314), "p = 0.031");
}

}  // namespace
}  // namespace isotach::discovery
