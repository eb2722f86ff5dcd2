// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/fit_slump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "calibration/parallel.hpp"
#include "calibration/uncertainty.hpp"

namespace isotach::calibration {

namespace {

using SlumpExperiments = std::vector<std::shared_ptr<const experiments::SlumpExperiment>>;

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

/// Simulations without a result.
long failures(const mpm::RunCounts& runs) {
  return runs.total() - runs[mpm::RunStatus::ok] - runs[mpm::RunStatus::not_settled];
}

/// The study's tests, whose simulations `tally` counts.
SlumpExperiments make_experiments(const datasets::Study& study, const SlumpFitOptions& options,
                                  const std::shared_ptr<RunTally>& tally) {
  const experiments::Simulate simulate =
      options.simulate ? options.simulate : plain_simulation(options.control.stop);
  const auto counted = [simulate, tally](const std::string& test, const model::Parameters<double>& parameters,
                                         const mpm::SlumpSetup& setup) {
    auto result = simulate(test, parameters, setup);
    tally->add(result ? mpm::status_of(*result) : result.error().status);
    return result;
  };
  SlumpExperiments all;
  for (const auto& test : study.slump_tests) {
    all.push_back(std::make_shared<experiments::SlumpExperiment>(test, counted));
  }
  return all;
}

/// Indices in the order in which threads should take the tests up, so that none waits for a long one at the
/// end.
std::vector<std::size_t> by_cost(const SlumpExperiments& all) {
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return all[a]->cost() > all[b]->cost(); });
  return order;
}

double rms_where(const experiments::Values& values, const std::vector<bool>& chosen) {
  experiments::Values subset;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (chosen[i]) subset.push_back(values[i]);
  }
  return subset.empty() ? std::numeric_limits<double>::quiet_NaN() : experiments::root_mean_square(subset);
}

tl::expected<std::vector<SlumpComparison>, FitFailure> compare_all(
    const SlumpExperiments& all, const model::Parameters<double>& parameters, int threads) {
  std::vector<tl::expected<mpm::SlumpResult, experiments::PredictionFailure>> simulations(all.size());
  const std::vector<std::size_t> order = by_cost(all);
  parallel_for(all.size(), threads,
               [&](std::size_t k) { simulations[order[k]] = all[order[k]]->simulate(parameters); });
  std::vector<SlumpComparison> comparisons;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!simulations[i]) {
      return tl::unexpected(FitFailure{simulations[i].error().message, simulations[i].error().interrupted});
    }
    SlumpComparison comparison{all[i], std::move(*simulations[i]), {}, 0.0, 0.0};
    comparison.distances = all[i]->distances(comparison.simulation);
    comparison.rms = experiments::root_mean_square(comparison.distances);
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

/// D_r stays: the oedometer's gauge has been applied.
Problem make_problem(const SlumpExperiments& all, const datasets::Study& study,
                     const model::Parameters<double>& at, const std::vector<model::ParameterId>& wanted,
                     int threads) {
  Experiments by_length;
  for (const std::size_t i : by_cost(all)) by_length.push_back(all[i]);
  return Problem(by_length, Parametrisation(at, wanted, {study.fit.bounds, {}}, GaugeChoice{}), threads);
}

}  // namespace

tl::expected<SlumpSearch, FitFailure> search_slump(const datasets::Study& study,
                                                   const model::Parameters<double>& start,
                                                   const std::vector<model::ParameterId>& wanted,
                                                   const SlumpFitOptions& options) {
  const auto tally = std::make_shared<RunTally>();
  const SlumpExperiments all = make_experiments(study, options, tally);
  const Problem problem = make_problem(all, study, start, wanted, options.threads);
  const Parametrisation& parametrisation = problem.parametrisation();

  NloptOptions nlopt;
  nlopt.first_step = options.first_step;
  nlopt.first_step_C_1 = options.first_step_C_1;
  nlopt.coordinate_tolerance = 0.01;  // simulations carry noise of about this size
  nlopt.cost_tolerance = 1e-3;
  nlopt.max_evaluations = options.max_evaluations;
  OptimiserResult search = minimise_with_nlopt(problem, parametrisation.start(), nlopt, options.control);
  if (search.interrupted) return tl::unexpected(FitFailure{"interrupted", true});
  if (search.trace.empty()) {
    return tl::unexpected(FitFailure{"no simulation succeeded; the last failure: " + search.last_failure});
  }
  SlumpSearch found{*parametrisation.at(search.coordinates), std::move(search), tally->counts(), {}};
  if (!found.search.converged) found.warnings.push_back("NLopt stopped early: " + found.search.termination);
  if (found.search.failed_evaluations > 0) {
    found.warnings.push_back(fmt::format("{} of {} evaluations failed and were refused; the last: {}",
                                         found.search.failed_evaluations, found.search.evaluations,
                                         found.search.last_failure));
  }
  return found;
}

tl::expected<SlumpFit, FitFailure> assess_slump(const datasets::Study& study, const SlumpSearch& found,
                                                const std::vector<model::ParameterId>& wanted,
                                                const SlumpFitOptions& options) {
  const auto tally = std::make_shared<RunTally>();
  const SlumpExperiments all = make_experiments(study, options, tally);
  const Problem problem = make_problem(all, study, found.parameters, wanted, options.threads);
  const std::vector<double> answer = problem.parametrisation().start();
  SlumpFit fit;
  FitResult& result = fit.result;
  result.free = problem.parametrisation().free();
  result.coordinates = problem.parametrisation().coordinates();
  result.main = found.search;
  result.warnings = found.warnings;
  result.parameters = found.parameters;

  auto uncertainty = estimate_uncertainty(problem, answer, Correlation::serial);
  if (!uncertainty) {
    return tl::unexpected(FitFailure{uncertainty.error().message, uncertainty.error().interrupted});
  }
  if (const long failed = failures(tally->counts()); failed > 0) {
    result.warnings.push_back(fmt::format(
        "{} simulation{} beside the answer failed: standard errors rest on one-sided differences there",
        failed, failed == 1 ? "" : "s"));
  }
  result.uncertainty = std::move(*uncertainty);
  result.correlation = correlation_of(result.uncertainty.covariance);
  result.estimates = estimate_parameters(problem, answer, result.uncertainty);

  auto comparisons = compare_all(all, found.parameters, options.threads);
  if (!comparisons) return tl::unexpected(comparisons.error());
  fit.comparisons = std::move(*comparisons);
  fit.rms_mould_gone = rms_mould_gone(fit.comparisons);
  fit.runs = found.runs;
  fit.runs += tally->counts();
  result.adequate = true;
  for (const SlumpComparison& comparison : fit.comparisons) {
    const experiments::Values scaled = comparison.experiment->scaled_residuals(comparison.distances);
    const TestSummary test{comparison.experiment->name(), comparison.experiment->held_out(), scaled.size(),
                           comparison.rms, experiments::root_mean_square(scaled)};
    if (!test.held_out && test.rms_over_noise > kAdequate) result.adequate = false;
    result.tests.push_back(test);
  }
  return fit;
}

tl::expected<SlumpFit, FitFailure> fit_slump(const datasets::Study& study,
                                             const model::Parameters<double>& start,
                                             const SlumpFitOptions& options) {
  const auto found = search_slump(study, start, study.fit.slump, options);
  if (!found) return tl::unexpected(found.error());
  if (options.control.callback) options.control.callback(-1, found->search.cost);
  return assess_slump(study, *found, study.fit.slump, options);
}

}  // namespace isotach::calibration
