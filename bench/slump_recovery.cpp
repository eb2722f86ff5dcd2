// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Recovery study of the slump fit: synthetic outlines of known I_v and C_1, fitted like measured ones; how
// often the 95 % intervals cover the truth, and whether what outlines cannot hold is ever called identified.
//
//   slump_recovery [studies] [seed] [threads] [points]   prints a Markdown report
//
// Both sides use surrogates, each learnt once from simulations at `points` places: the generator's have other
// cells (7 across the radius, 6 for the fitter) and other places. Tests are the fitted five of
// datasets/mud-a. A study is a truth within +-25 % of I_v = 0.03 and C_1 in 0.03 .. 0.13; reading errors of
// 0.8 mm, and errors that an outline shares, of 0.9 mm: smooth waves along it, half of each kept through
// time, which is not the covariance that the fit assumes. To first order in the distances, the outline
// measured at truth t is missed by the fitter's at x by d_fitter(x) - d_generator(t), d from the same
// reference outlines.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "bench/outline_noise.hpp"
#include "calibration/fit_slump.hpp"
#include "calibration/profile_verdict.hpp"
#include "calibration/slump_map.hpp"

namespace {

using namespace isotach;
using calibration::Problem;
using experiments::SlumpExperiment;
using model::ParameterId;

constexpr double kReading = 0.8e-3;
constexpr double kShared = 0.9e-3;
constexpr double kBlurred = 4.0;  // times these errors: a picture taken from far away
constexpr int kGeneratorCells = 7;
constexpr std::size_t kReferencePoints = 40;

datasets::Study base_study() {
  datasets::Study study =
      datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
  std::erase_if(study.slump_tests, [](const datasets::SlumpTest& test) { return test.hold_out; });
  for (datasets::SlumpTest& test : study.slump_tests) test.reference.reset();
  auto values = study.material.values();
  values[ParameterId::I_v] = 0.03;
  values[ParameterId::C_1] = 0.08;
  study.material = model::Parameters<double>::create(values).value();
  study.fit.bounds[static_cast<std::size_t>(ParameterId::I_v)] = datasets::Bounds{0.017, 0.05};
  study.fit.bounds[static_cast<std::size_t>(ParameterId::C_1)] = datasets::Bounds{0.0, 0.2};
  return study;
}

const experiments::Simulate simulate = calibration::plain_simulation(nullptr);

void set_cells(datasets::Study& study, int cells) {
  for (datasets::SlumpTest& test : study.slump_tests) {
    test.setup.numerics.cell_size = 0.5 * test.setup.mould.diameter / cells;
  }
}

/// The outlines that the generator gives at the study's material, as if they had been measured.
void set_reference(datasets::Study& study) {
  for (datasets::SlumpTest& test : study.slump_tests) {
    const auto result = simulate(test.name, study.material, test.setup);
    if (!result) throw std::runtime_error(result.error().message);
    for (std::size_t k = 0; k < test.outlines.size(); ++k) {
      test.outlines[k].points.clear();
      for (const auto& point : experiments::resampled(result->outlines[k].points, kReferencePoints)) {
        test.outlines[k].points.push_back({point.r, point.z});
      }
    }
  }
}

using Tests = std::vector<std::shared_ptr<const SlumpExperiment>>;

Tests experiments_of(const datasets::Study& study, const experiments::SharedError& error) {
  Tests tests;
  for (const auto& test : study.slump_tests) {
    tests.push_back(std::make_shared<SlumpExperiment>(
        test, experiments::SlumpModel{.simulate = simulate, .simulation_error = error}));
  }
  return tests;
}

Problem problem_of(const Tests& tests, const datasets::Study& study, int threads) {
  return Problem({tests.begin(), tests.end()},
                 calibration::Parametrisation(study.material, {ParameterId::I_v, ParameterId::C_1},
                                              {study.fit.bounds, {}}, {}),
                 threads);
}

std::shared_ptr<const calibration::SlumpSurrogate> learn(const Problem& problem, std::size_t points,
                                                         unsigned seed, int threads) {
  calibration::TrainingSet set;
  const calibration::CoordinateBox box{problem.parametrisation().lower(), problem.parametrisation().upper()};
  calibration::add_points(problem, box, points, seed, threads, {}, set);
  if (set.failed > 0) fmt::print("{} points failed; the last: {}\n\n", set.failed, set.last_failure);
  return std::make_shared<calibration::SlumpSurrogate>(problem, box, set);
}

/// A test with what was measured at the truth in the place of nothing.
class Measured final : public experiments::Experiment {
 public:
  Measured(std::shared_ptr<const experiments::Experiment> stand_in, experiments::Values measured)
      : stand_in_(std::move(stand_in)), measured_(std::move(measured)) {}
  [[nodiscard]] const std::string& name() const override { return stand_in_->name(); }
  [[nodiscard]] bool held_out() const override { return false; }
  [[nodiscard]] const experiments::Values& measured() const override { return measured_; }
  [[nodiscard]] std::string_view quantity() const override { return stand_in_->quantity(); }
  [[nodiscard]] const experiments::Values& noise() const override { return stand_in_->noise(); }
  [[nodiscard]] tl::expected<experiments::Values, experiments::PredictionFailure> predict(
      const model::Parameters<double>& parameters, std::span<const double> local) const override {
    return stand_in_->predict(parameters, local);
  }

 private:
  std::shared_ptr<const experiments::Experiment> stand_in_;
  experiments::Values measured_;
};

struct Score {
  int studies = 0;
  int covered[2] = {0, 0};
  int identified[2] = {0, 0};
  int undetermined[2] = {0, 0};
  int hopeless[2] = {0, 0};  ///< the expected interval is twice as wide as may be called identified
  int hopeless_identified[2] = {0, 0};
  double half_width[2] = {0.0, 0.0};  ///< sums of the intervals', relative to what they are judged against
  double misfit = 0.0;                ///< sum of rms of residuals
};

Tests chosen(const Tests& tests, const std::vector<std::size_t>& used) {
  Tests some;
  for (const std::size_t t : used) some.push_back(tests[t]);
  return some;
}

/// The runs of some of the tests.
calibration::SimulationError chosen(const calibration::SimulationError& error,
                                    const std::vector<std::size_t>& used) {
  calibration::SimulationError some = error;
  const auto pick = [&used](auto& runs) {
    const auto all = runs;
    runs.clear();
    for (const std::size_t t : used) runs.push_back(all[t]);
  };
  pick(some.runs);
  for (calibration::NumericalVariant& variant : some.variants) pick(variant.runs);
  return some;
}

/// The rows of some of the tests.
Eigen::MatrixXd rows_of(const Eigen::MatrixXd& directions, const Tests& tests,
                        const std::vector<std::size_t>& used) {
  std::vector<Eigen::Index> rows;
  for (const std::size_t t : used) {
    Eigen::Index first = 0;
    for (std::size_t i = 0; i < t; ++i) first += static_cast<Eigen::Index>(tests[i]->measured().size());
    for (std::size_t i = 0; i < tests[t]->measured().size(); ++i) {
      rows.push_back(first + static_cast<Eigen::Index>(i));
    }
  }
  return directions(rows, Eigen::all);
}

/// `errors`: directions of the errors of both surrogates, rows as those of all tests.
void one_study(const Problem& fitter, const Problem& generator, const Eigen::MatrixXd& errors,
               const Tests& tests, const std::vector<std::size_t>& used,
               const calibration::SimulationError& error, double times, std::mt19937_64& random,
               Score& score) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<double> truth{std::log(0.03 * (0.75 + 0.5 * unit(random))), 0.03 + 0.1 * unit(random)};
  const auto true_parameters = generator.parametrisation().at(truth);
  calibration::Experiments measured;
  for (const std::size_t t : used) {
    experiments::Values values = *generator.fitted()[t]->predict(*true_parameters, {});
    const experiments::Values noise =
        tests[t]->decorrelated(bench::draw_errors(*tests[t], {times * kReading, times * kShared}, random));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += noise[i];
    measured.push_back(std::make_shared<Measured>(fitter.fitted()[t], std::move(values)));
  }
  Problem problem(measured, fitter.parametrisation(), 1);
  problem.set_common_error(
      calibration::CommonError(calibration::directions_of(chosen(error, used), chosen(tests, used)))
          .with(rows_of(errors, tests, used)));
  calibration::NloptOptions options;
  options.restarts = 2;
  const auto found =
      calibration::minimise_with_nlopt(problem, problem.parametrisation().start(), options, {});
  const auto uncertainty =
      calibration::estimate_uncertainty(problem, found.coordinates, calibration::Correlation::independent);
  const auto at_truth =
      calibration::estimate_uncertainty(problem, truth, calibration::Correlation::independent);
  if (!uncertainty || !at_truth) throw std::runtime_error("a study has no covariance");
  const double threshold = std::pow(uncertainty->quantile() * uncertainty->inflation, 2.0);
  ++score.studies;
  score.misfit += std::sqrt(2.0 * found.cost / static_cast<double>(problem.value_count()));
  for (std::size_t k = 0; k < 2; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double std_error = std::sqrt(uncertainty->covariance(i, i));
    const auto profile = calibration::profile(problem, found.coordinates, k, std_error, threshold, {});
    const auto& coordinate = problem.parametrisation().coordinates()[k];
    const double range =
        calibration::range_of(*coordinate.id, *problem.parametrisation().at(found.coordinates));
    const double half =
        0.5 * (coordinate.quantity(profile.upper) - coordinate.quantity(profile.lower)) / range;
    calibration::ParameterEstimate estimate;
    estimate.verdict =
        calibration::judge(half, 1.0, problem.parametrisation().at_bound(found.coordinates, k));
    calibration::heed_profile(profile, estimate);
    const calibration::Verdict verdict = estimate.verdict;
    const double expected = 1.96 * std::sqrt(at_truth->covariance(i, i)) / at_truth->inflation *
                            (coordinate.logarithmic ? 1.0 : 1.0 / range);
    const bool hopeless = expected > 0.5;
    score.covered[k] += truth[k] >= profile.lower && truth[k] <= profile.upper ? 1 : 0;
    score.identified[k] += verdict == calibration::Verdict::identified ? 1 : 0;
    score.undetermined[k] += verdict == calibration::Verdict::undetermined ? 1 : 0;
    score.hopeless[k] += hopeless ? 1 : 0;
    score.hopeless_identified[k] += hopeless && verdict == calibration::Verdict::identified ? 1 : 0;
    score.half_width[k] += half;
  }
}

void print_row(const char* protocol, const Score& score) {
  constexpr const char* kNames[] = {"I_v", "C_1"};
  for (std::size_t k = 0; k < 2; ++k) {
    const double n = score.studies;
    fmt::print("| {} | {} | {} | {:.1f} | {:.0f} | {:.1f} | {:.1f} | {} | {} | {:.2f} |\n", protocol,
               kNames[k], score.studies, 100.0 * score.covered[k] / n, 100.0 * score.half_width[k] / n,
               100.0 * score.identified[k] / n, 100.0 * score.undetermined[k] / n, score.hopeless[k],
               score.hopeless_identified[k], score.misfit / n);
  }
}

/// Both sides of the studies of some tests.
struct Sides {
  Tests tests;  ///< of the fitter
  calibration::SimulationError error;
  double times;  ///< the usual error of outlines
  std::shared_ptr<const calibration::SlumpSurrogate> fitter_surrogate;
  std::shared_ptr<const calibration::SlumpSurrogate> generator_surrogate;
  Problem fitter;
  Problem generator;

  /// Directions of the errors of both surrogates, rows as those of all tests.
  [[nodiscard]] Eigen::MatrixXd errors() const {
    const Eigen::MatrixXd& of_fitter = fitter_surrogate->error_directions();
    const Eigen::MatrixXd& of_generator = generator_surrogate->error_directions();
    Eigen::MatrixXd both(of_fitter.rows(), of_fitter.cols() + of_generator.cols());
    both << of_fitter, of_generator;
    return both;
  }
};

Sides make_sides(datasets::Study study, double times, std::size_t points, unsigned seed, int threads) {
  for (datasets::SlumpTest& test : study.slump_tests) {
    const double all = times * std::hypot(kReading, kShared);
    test.noise = {all, all, times * kShared};
  }
  auto error = calibration::measure_simulation_error(study, study.material, simulate, threads);
  if (!error) throw std::runtime_error(error.error().message);
  datasets::Study other = study;
  set_cells(other, kGeneratorCells);
  set_reference(other);
  for (std::size_t t = 0; t < study.slump_tests.size(); ++t) {
    study.slump_tests[t].outlines = other.slump_tests[t].outlines;
  }
  const Tests tests = experiments_of(study, error->error);
  const Problem simulated = problem_of(tests, study, threads);
  const Problem generated = problem_of(experiments_of(other, error->error), other, threads);
  const auto fitter = learn(simulated, points, seed + 1000, threads);
  const auto generator = learn(generated, points, seed + 2000, threads);
  return {tests,
          std::move(*error),
          times,
          fitter,
          generator,
          calibration::with_surrogate(simulated, fitter),
          calibration::with_surrogate(generated, generator)};
}

/// One of the study's tests, read once, when the mud has come to rest.
datasets::Study last_outline_of(datasets::Study study, const std::string& name) {
  std::erase_if(study.slump_tests, [&](const datasets::SlumpTest& test) { return test.name != name; });
  datasets::SlumpTest& test = study.slump_tests.front();
  test.outlines.erase(test.outlines.begin(), test.outlines.end() - 1);
  test.setup.times = {test.outlines.front().time};
  return study;
}

Score recover(const Sides& sides, const std::vector<std::size_t>& used, long studies, unsigned seed) {
  std::mt19937_64 random(seed);
  const Eigen::MatrixXd errors = sides.errors();
  Score score;
  for (long s = 0; s < studies; ++s) {
    one_study(sides.fitter, sides.generator, errors, sides.tests, used, sides.error, sides.times, random,
              score);
  }
  return score;
}

void print_sides(const char* what, const Sides& sides) {
  fmt::print(
      "{}: error of the simulations taken for the covariance {:.2f} mm, {:.2f} mm while lifting. Points left "
      "out are missed by {:.2f} (fitter) and {:.2f} (generator) times the noise.\n\n",
      what, 1e3 * sides.error.error.outline, 1e3 * sides.error.error.lifting, sides.fitter_surrogate->error(),
      sides.generator_surrogate->error());
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, long otherwise) { return argc > i ? std::atol(argv[i]) : otherwise; };
  const long studies = number(1, 200);
  const auto seed = static_cast<unsigned>(number(2, 1));
  const int threads = static_cast<int>(number(3, 2));
  const auto points = static_cast<std::size_t>(number(4, 45));
  try {
    const datasets::Study study = base_study();
    const Sides all = make_sides(study, 1.0, points, seed, threads);
    const datasets::Study at_rest = last_outline_of(study, "slump-2");
    const Sides last = make_sides(at_rest, 1.0, points, seed, threads);
    const Sides blurred = make_sides(at_rest, kBlurred, points, seed, threads);
    print_sides("Five tests", all);
    print_sides("The last outline of slump-2", last);
    print_sides("The same, blurred", blurred);
    fmt::print(
        "| protocol | | studies | covered by 95 % (%) | half width (%) | identified (%) | undetermined (%) | "
        "hopeless | of them identified | misfit |\n|---|---|---|---|---|---|---|---|---|---|\n");
    print_row("five tests", recover(all, {0, 1, 2, 3, 4}, studies, seed));
    print_row("slump-2", recover(all, {1}, studies, seed + 1));
    print_row("last outline of slump-2", recover(last, {0}, studies, seed + 2));
    print_row("the same, blurred", recover(blurred, {0}, studies, seed + 3));
  } catch (const std::exception& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return 1;
  }
  return 0;
}
