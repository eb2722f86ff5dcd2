// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/fit_slump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>

#include "calibration/outline_volume.hpp"
#include "calibration/parallel.hpp"
#include "calibration/profile_verdict.hpp"
#include "calibration/uncertainty.hpp"

namespace isotach::calibration {

namespace {

/// Counts how simulations end.
class RunTally {
 public:
  void add(mpm::RunStatus status) {
    const std::lock_guard lock(mutex_);
    ++counts_[status];
  }
  [[nodiscard]] mpm::RunCounts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  mutable std::mutex mutex_;
  mpm::RunCounts counts_;
};

void tell(const SlumpFitOptions& options, SlumpFitStage stage) {
  if (options.stage) options.stage(stage);
}

constexpr double kMostVolumeExcess = 0.03;  // of the fill; what points a millimetre off can make of it

/// Simulations without a result.
long failures(const mpm::RunCounts& runs) {
  return runs.total() - runs[mpm::RunStatus::ok] - runs[mpm::RunStatus::not_settled];
}

/// Simulations as the options want them, counted by `tally`.
experiments::Simulate counted(const SlumpFitOptions& options, const std::shared_ptr<RunTally>& tally) {
  const experiments::Simulate simulate =
      options.simulate ? options.simulate : plain_simulation(options.control.stop);
  return [simulate, tally](const std::string& test, const model::Parameters<double>& parameters,
                           const mpm::SlumpSetup& setup) {
    auto result = simulate(test, parameters, setup);
    tally->add(result ? mpm::status_of(*result) : result.error().status);
    return result;
  };
}

double rms_where(const experiments::Values& values, const std::vector<bool>& chosen) {
  experiments::Values subset;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (chosen[i]) subset.push_back(values[i]);
  }
  return subset.empty() ? std::numeric_limits<double>::quiet_NaN() : experiments::root_mean_square(subset);
}

/// Names the tests whose outlines cannot have the volume that the mould held.
std::optional<std::string> volume_warning(const std::vector<SlumpComparison>& comparisons) {
  std::string tests;
  for (const SlumpComparison& comparison : comparisons) {
    if (std::abs(comparison.volume_excess) <= kMostVolumeExcess) continue;
    tests += fmt::format("{}{} ({:+.1f} %)", tests.empty() ? "" : ", ", comparison.experiment->name(),
                         100.0 * comparison.volume_excess);
  }
  if (tests.empty()) return std::nullopt;
  return fmt::format(
      "outlines hold more or less than the mould did: {}. Their scale, edge or axis is off, and no "
      "simulation "
      "that keeps its volume can meet them everywhere",
      tests);
}

tl::expected<std::vector<SlumpComparison>, FitFailure> compare_all(
    const SlumpExperiments& all, const Problem& problem, const std::vector<double>& x,
    const model::Parameters<double>& parameters, int threads) {
  std::vector<tl::expected<mpm::SlumpResult, experiments::PredictionFailure>> simulations(all.size());
  const std::vector<std::size_t> order = by_cost({all.begin(), all.end()});
  parallel_for(all.size(), threads, [&](std::size_t k) {
    const std::size_t i = order[k];
    simulations[i] = all[i]->simulate_at_best(parameters, problem.parametrisation().local_of(*all[i], x));
  });
  std::vector<SlumpComparison> comparisons;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!simulations[i]) {
      return tl::unexpected(FitFailure{simulations[i].error().message, simulations[i].error().interrupted});
    }
    SlumpComparison comparison{all[i], std::move(*simulations[i]), {}};
    comparison.distances = all[i]->distances(comparison.simulation);
    comparison.rms = experiments::root_mean_square(comparison.distances);
    comparison.volume_excess = volume_excess(all[i]->test());
    comparison.rms_mould_gone = rms_where(comparison.distances, all[i]->mould_gone());
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

double rms_mould_gone(const std::vector<SlumpComparison>& comparisons) {
  experiments::Values values;
  for (const SlumpComparison& comparison : comparisons) {
    for (std::size_t i = 0; i < comparison.distances.size(); ++i) {
      if (comparison.experiment->mould_gone()[i]) values.push_back(comparison.distances[i]);
    }
  }
  return experiments::root_mean_square(values);
}

}  // namespace

std::string_view name_of(SlumpFitStage stage) {
  switch (stage) {
    case SlumpFitStage::simulation_error:
      return "error of the simulations";
    case SlumpFitStage::uncertainty:
      return "uncertainty";
    case SlumpFitStage::map:
      return "map and profiles";
    case SlumpFitStage::comparison:
      return "comparison of all tests";
  }
  return "";
}

experiments::Simulate plain_simulation(const std::atomic<bool>* stop) {
  return [stop](const std::string&, const model::Parameters<double>& parameters,
                const mpm::SlumpSetup& setup) -> tl::expected<mpm::SlumpResult, mpm::RunFailure> {
    mpm::RunOptions options;
    options.stop = stop;
    options.history = false;
    auto result = mpm::run_slump(parameters, setup, options);
    if (result) return std::move(*result);
    return tl::unexpected(mpm::RunFailure{mpm::status_of(result.error()), std::move(result.error().message)});
  };
}

namespace {

constexpr double kCoordinateTolerance = 0.01;  // simulations carry noise of about this size
constexpr double kCostTolerance = 1e-3;

/// One search on simulations.
OptimiserResult search_by(datasets::SlumpRoute route, const Problem& problem,
                          const std::vector<double>& start, const SlumpFitOptions& options) {
  if (route == datasets::SlumpRoute::ceres) {
    CeresOptions ceres;
    // an iteration is a linearisation: an evaluation and two for each coordinate
    ceres.max_iterations = std::max(1, options.max_evaluations / (1 + 2 * static_cast<int>(start.size())));
    ceres.function_tolerance = kCostTolerance;
    // Ceres takes it relative to the length of x
    const double length = Eigen::Map<const Eigen::VectorXd>(start.data(), std::ssize(start)).norm();
    ceres.parameter_tolerance = kCoordinateTolerance / std::max(1.0, length);
    return minimise_with_ceres(problem, start, ceres, options.control);
  }
  NloptOptions nlopt;
  nlopt.search = route == datasets::SlumpRoute::sbplx ? LocalSearch::sbplx : LocalSearch::bobyqa;
  nlopt.first_step = options.first_step;
  nlopt.first_step_C_1 = options.first_step_C_1;
  nlopt.coordinate_tolerance = kCoordinateTolerance;
  nlopt.cost_tolerance = kCostTolerance;
  nlopt.max_evaluations = options.max_evaluations;
  return minimise_with_nlopt(problem, start, nlopt, options.control);
}

}  // namespace

namespace {

/// The best of the routes' answers; `others` are those of the other routes.
tl::expected<OptimiserResult, FitFailure> search_by_routes(const Problem& problem,
                                                           const std::vector<double>& start,
                                                           const RunTally& tally,
                                                           const SlumpFitOptions& options,
                                                           std::vector<OptimiserResult>& others) {
  others.clear();
  for (const datasets::SlumpRoute route : options.routes) {
    const long before = tally.counts().total();
    OptimiserResult search = search_by(route, problem, start, options);
    search.simulations = tally.counts().total() - before;
    if (search.interrupted) return tl::unexpected(FitFailure{"interrupted", true});
    others.push_back(std::move(search));
  }
  const auto best = std::min_element(others.begin(), others.end(), [](const auto& a, const auto& b) {
    return std::pair(a.trace.empty(), a.cost) < std::pair(b.trace.empty(), b.cost);
  });
  OptimiserResult search = std::move(*best);
  others.erase(best);
  if (search.trace.empty()) {
    return tl::unexpected(FitFailure{"no simulation succeeded; the last failure: " + search.last_failure});
  }
  return search;
}

constexpr int kMostCorrections = 3;
constexpr double kCorrectionStays = 0.02;  // of a logarithm: corrections change by far less than simulations

}  // namespace

tl::expected<SlumpSearch, FitFailure> search_slump(const datasets::Study& study,
                                                   const model::Parameters<double>& start,
                                                   const std::vector<model::ParameterId>& wanted,
                                                   const SlumpFitOptions& options) {
  return search_slump(study, SlumpPlace{start, study.effects, {}}, wanted, options);
}

tl::expected<SlumpSearch, FitFailure> search_slump(const datasets::Study& study, const SlumpPlace& start,
                                                   const std::vector<model::ParameterId>& wanted,
                                                   const SlumpFitOptions& options) {
  const auto tally = std::make_shared<RunTally>();
  const experiments::Simulate simulate = counted(options, tally);
  SlumpSearch found{start, {}, {}, {}, {}, {}};
  if (options.simulation_error) {
    found.simulation_error = *options.simulation_error;
  } else {
    tell(options, SlumpFitStage::simulation_error);
    auto measured = measure_simulation_error(study, start.parameters, simulate, options.threads);
    if (!measured) return tl::unexpected(measured.error());
    found.simulation_error = std::move(*measured);
  }
  SlumpFitOptions pass_options = options;
  for (int pass = 1;; ++pass) {
    const auto slumps =
        corrected_slumps(study, found.at, wanted, simulate, found.simulation_error, options.threads);
    if (!slumps) return tl::unexpected(slumps.error());
    const std::vector<double>& from = slumps->start;
    auto best = search_by_routes(slumps->problem, from, *tally, pass_options, found.others);
    if (!best) return tl::unexpected(best.error());
    const std::vector<double>& to = best->coordinates;
    double moved = 0.0;
    for (std::size_t k = 0; k < to.size(); ++k) moved = std::max(moved, std::abs(to[k] - from[k]));
    found.at = slumps->place_at(to);
    found.search = std::move(*best);
    if (!has_reference(study) || moved < kCorrectionStays || pass == kMostCorrections) break;
    pass_options.first_step = std::min(pass_options.first_step, moved);
    pass_options.first_step_C_1 = std::min(pass_options.first_step_C_1, moved);
  }
  found.runs = tally->counts();
  if (!found.search.converged) {
    found.warnings.push_back(
        fmt::format("{} stopped early: {}", found.search.route, found.search.termination));
  }
  if (found.search.failed_evaluations > 0) {
    found.warnings.push_back(fmt::format("{} of {} evaluations failed and were refused; the last: {}",
                                         found.search.failed_evaluations, found.search.evaluations,
                                         found.search.last_failure));
  }
  return found;
}

namespace {

/// Moves the answer to the surrogate's least misfit where simulations there agree better.
void heed_map(const Problem& problem, const SlumpMap& map, std::vector<double>& answer, FitResult& result) {
  const auto residuals = problem.residuals(map.best);
  if (!residuals) return;
  const double cost = cost_of(*residuals);
  ++result.main.evaluations;
  if (!(cost < result.main.cost)) return;
  answer = map.best;
  result.main.cost = cost;
  result.main.coordinates = answer;
  result.main.trace.push_back({result.main.evaluations, cost, answer});
  result.parameters = *problem.parametrisation().at(answer);
}

/// By how much other cells and points would move the answer.
std::vector<NumericalShift> shifts_of(const Problem& problem, const std::vector<double>& answer,
                                      const SlumpExperiments& all, const SimulationError& error) {
  const auto at = problem.linearise(answer);
  if (!at) return {};
  return numerical_shifts(*at, problem.common_error(), fitted_of(all), error);
}

/// Interval and verdict as a profile has them. `range` is that which judge() wants.
template <class Estimate>
void heed_profile_of(const Coordinate& coordinate, const Profile& profile, double range, bool at_bound,
                     Estimate& estimate) {
  estimate.ci95_lower = coordinate.quantity(profile.lower);
  estimate.ci95_upper = coordinate.quantity(profile.upper);
  if (estimate.verdict != Verdict::undetermined) {
    estimate.verdict = judge(0.5 * (estimate.ci95_upper - estimate.ci95_lower), range, at_bound);
  }
  heed_profile(profile, estimate);
}

/// Intervals and verdicts as the profiles have them.
void heed_profiles(const Problem& problem, const SlumpMap& map, FitResult& result) {
  for (const Profile& profile : map.profiles) {
    const std::size_t k = profile.coordinate;
    const Coordinate& coordinate = problem.parametrisation().coordinates()[k];
    const bool at_bound = problem.parametrisation().at_bound(map.best, k);
    if (coordinate.id) {
      heed_profile_of(coordinate, profile, range_of(*coordinate.id, *result.parameters), at_bound,
                      result.estimates[static_cast<std::size_t>(*coordinate.id)]);
    } else {
      LocalEstimate& estimate = result.local_estimates[k - result.free.size()];
      heed_profile_of(coordinate, profile, std::abs(estimate.value), at_bound, estimate);
    }
  }
}

}  // namespace

tl::expected<SlumpFit, FitFailure> assess_slump(const datasets::Study& study, const SlumpSearch& found,
                                                const std::vector<model::ParameterId>& wanted,
                                                const SlumpFitOptions& options) {
  const auto tally = std::make_shared<RunTally>();
  const auto slumps = corrected_slumps(study, found.at, wanted, counted(options, tally),
                                       found.simulation_error, options.threads);
  if (!slumps) return tl::unexpected(slumps.error());
  const SlumpExperiments& all = slumps->tests;
  const Problem& problem = slumps->problem;
  std::vector<double> answer = slumps->start;
  SlumpFit fit;
  FitResult& result = fit.result;
  fit.simulation_error = found.simulation_error;
  fit.corrections = slumps->corrections;
  if (fit.corrections.failed > 0) {
    fit.result.warnings.push_back(fmt::format(
        "{} of the tests could not be simulated with the reference numerics, and stay uncorrected",
        fit.corrections.failed));
  }
  result.free = problem.parametrisation().free();
  result.coordinates = problem.parametrisation().coordinates();
  result.main = found.search;
  fit.other_routes = found.others;
  result.warnings = found.warnings;
  result.parameters = found.at.parameters;

  tell(options, SlumpFitStage::uncertainty);
  auto uncertainty = estimate_uncertainty(problem, answer, Correlation::independent);
  if (!uncertainty) {
    return tl::unexpected(FitFailure{uncertainty.error().message, uncertainty.error().interrupted});
  }
  if (const long failed = failures(tally->counts()); failed > 0) {
    result.warnings.push_back(fmt::format(
        "{} simulation{} beside the answer failed: standard errors rest on one-sided differences there",
        failed, failed == 1 ? "" : "s"));
  }
  result.uncertainty = std::move(*uncertainty);
  if (options.map) {
    tell(options, SlumpFitStage::map);
    auto map =
        map_slump(problem, answer, result.uncertainty, {options.threads, options.seed, options.control});
    if (!map) {
      if (map.error().interrupted) return tl::unexpected(map.error());
      result.warnings.push_back("no map, no profiles: " + map.error().message);
    } else {
      heed_map(problem, *map, answer, result);
      fit.map = std::move(*map);
      // differences of a surrogate carry none of the scatter of simulations
      const Problem on_surrogate = with_surrogate(problem, fit.map->surrogate);
      if (auto smooth = estimate_uncertainty(on_surrogate, answer, Correlation::independent)) {
        result.uncertainty = std::move(*smooth);
        fit.shifts = shifts_of(on_surrogate, answer, all, fit.simulation_error);
      }
    }
  }
  if (fit.shifts.empty()) fit.shifts = shifts_of(problem, answer, all, fit.simulation_error);
  result.correlation = correlation_of(result.uncertainty.covariance);
  result.estimates = estimate_parameters(problem, answer, result.uncertainty);
  result.local_estimates = estimate_locals(problem, answer, result.uncertainty);
  if (fit.map) heed_profiles(problem, *fit.map, result);

  tell(options, SlumpFitStage::comparison);
  const SlumpPlace place = slumps->place_at(answer);
  fit.effects = place.effects;
  fit.mud = place.mud;
  auto comparisons = compare_all(all, problem, answer, *result.parameters, options.threads);
  if (!comparisons) return tl::unexpected(comparisons.error());
  fit.comparisons = std::move(*comparisons);
  fit.rms_mould_gone = rms_mould_gone(fit.comparisons);
  fit.runs = found.runs;
  fit.runs += tally->counts();
  result.adequate = true;
  for (const SlumpComparison& comparison : fit.comparisons) {
    const experiments::SlumpExperiment& experiment = *comparison.experiment;
    const TestSummary test{experiment.name(), experiment.held_out(), comparison.distances.size(),
                           comparison.rms,
                           experiments::root_mean_square(experiment.decorrelated(comparison.distances))};
    if (!test.held_out && test.rms_over_noise > kAdequate) result.adequate = false;
    result.tests.push_back(test);
  }
  if (auto warning = volume_warning(fit.comparisons)) result.warnings.push_back(std::move(*warning));
  return fit;
}

tl::expected<SlumpFit, FitFailure> fit_slump(const datasets::Study& study,
                                             const model::Parameters<double>& start,
                                             const SlumpFitOptions& options) {
  SlumpFitOptions by_study = options;
  by_study.routes = study.fit.slump_routes;
  const auto found = search_slump(study, start, study.fit.slump, by_study);
  if (!found) return tl::unexpected(found.error());
  return assess_slump(study, *found, study.fit.slump, by_study);
}

}  // namespace isotach::calibration
