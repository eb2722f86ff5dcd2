// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The routes by NLopt, without derivatives: BOBYQA, and global searches.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

#include "calibration/optimisers.hpp"

namespace isotach::calibration {

namespace {

// Cost of a point whose prediction failed: above anything a fit can meet, finite so that BOBYQA's models
// survive.
constexpr double kRefused = 1e12;
constexpr double kShorterStep = 0.2;

std::string describe(nlopt::result code) {
  switch (code) {
    case nlopt::SUCCESS:
      return "converged";
    case nlopt::STOPVAL_REACHED:
      return "stop value reached";
    case nlopt::FTOL_REACHED:
      return "cost tolerance reached";
    case nlopt::XTOL_REACHED:
      return "coordinate tolerance reached";
    case nlopt::MAXEVAL_REACHED:
      return "limit of evaluations reached";
    case nlopt::MAXTIME_REACHED:
      return "limit of time reached";
    default:
      return "ended with code " + std::to_string(code);
  }
}

struct Search {
  const Problem& problem;
  const OptimiserControl& control;
  OptimiserResult& result;
  nlopt::opt& optimiser;

  double operator()(const std::vector<double>& x) {
    if (control.stopped()) {
      result.interrupted = true;
      optimiser.force_stop();
      return kRefused;
    }
    ++result.evaluations;
    const auto evaluation = problem.residuals(x);
    if (!evaluation) {
      if (evaluation.error().interrupted) {
        result.interrupted = true;
        optimiser.force_stop();
        return kRefused;
      }
      ++result.failed_evaluations;
      result.last_failure = evaluation.error().message;
      return kRefused;
    }
    const double cost = cost_of(*evaluation);
    if (result.trace.empty() || cost < result.cost) {
      result.cost = cost;
      result.coordinates = x;
      result.trace.push_back({result.evaluations, cost, x});
    }
    if (control.callback) control.callback(result.evaluations, result.cost);
    return cost;
  }
};

double objective(const std::vector<double>& x, std::vector<double>&, void* search) {
  return (*static_cast<Search*>(search))(x);
}

/// One run of `optimiser` from the best point so far; how it ended goes into the result.
void run_once(nlopt::opt& optimiser, const Problem& problem, const OptimiserControl& control,
              OptimiserResult& result) {
  Search search{problem, control, result, optimiser};
  optimiser.set_min_objective(objective, &search);
  std::vector<double> x = result.coordinates;
  double cost = 0.0;
  try {
    const nlopt::result code = optimiser.optimize(x, cost);
    result.termination = describe(code);
    result.converged = code == nlopt::XTOL_REACHED || code == nlopt::FTOL_REACHED || code == nlopt::SUCCESS;
  } catch (const nlopt::roundoff_limited&) {
    // no further progress is possible in double precision: the trust region has shrunk to rounding
    result.termination = "limited by rounding";
    result.converged = true;
  } catch (const nlopt::forced_stop&) {
    result.termination = "interrupted";
  }
}

nlopt::algorithm algorithm_of(GlobalSearch search) {
  switch (search) {
    case GlobalSearch::crs2:
      return nlopt::GN_CRS2_LM;
    case GlobalSearch::isres:
      return nlopt::GN_ISRES;
    case GlobalSearch::esch:
      return nlopt::GN_ESCH;
    case GlobalSearch::mlsl:
      return nlopt::G_MLSL_LDS;
  }
  return nlopt::GN_CRS2_LM;
}

}  // namespace

std::string_view name_of(GlobalSearch search) {
  switch (search) {
    case GlobalSearch::crs2:
      return "CRS2";
    case GlobalSearch::isres:
      return "ISRES";
    case GlobalSearch::esch:
      return "ESCH";
    case GlobalSearch::mlsl:
      return "MLSL";
  }
  return "";
}

OptimiserResult search_globally(const Problem& problem, GlobalSearch search, const std::vector<double>& start,
                                const GlobalOptions& options, const OptimiserControl& control) {
  OptimiserResult result;
  result.coordinates = start;
  for (std::size_t k = 0; k < start.size(); ++k) {
    result.coordinates[k] = std::clamp(start[k], options.lower[k], options.upper[k]);
  }
  result.cost = kRefused;
  const auto dimension = static_cast<unsigned>(start.size());
  nlopt::srand(options.seed);  // of this thread
  nlopt::opt optimiser(algorithm_of(search), dimension);
  optimiser.set_lower_bounds(options.lower);
  optimiser.set_upper_bounds(options.upper);
  optimiser.set_maxeval(options.max_evaluations);
  if (search == GlobalSearch::mlsl) {
    nlopt::opt local(dimension > 1 ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, dimension);
    local.set_xtol_abs(1e-3);
    optimiser.set_local_optimizer(local);
  }
  run_once(optimiser, problem, control, result);
  const int searched = result.evaluations;
  if (!result.interrupted && !result.trace.empty()) {
    NloptOptions polish;
    polish.first_step = polish.first_step_C_1 = 0.02;
    polish.coordinate_tolerance = 1e-6;
    OptimiserResult polished = minimise_with_nlopt(problem, result.coordinates, polish, control);
    for (TracePoint& point : polished.trace) {
      point.evaluation += searched;
      if (point.cost < result.cost) result.trace.push_back(point);
    }
    if (polished.cost < result.cost) {
      result.coordinates = polished.coordinates;
      result.cost = polished.cost;
    }
    result.converged = polished.converged;
    result.interrupted = polished.interrupted;
    result.evaluations += polished.evaluations;
    result.failed_evaluations += polished.failed_evaluations;
    result.termination += ", then BOBYQA: " + polished.termination;
  }
  result.route = fmt::format("NLopt ({})", name_of(search));
  return result;
}

OptimiserResult minimise_with_nlopt(const Problem& problem, const std::vector<double>& start,
                                    const NloptOptions& options, const OptimiserControl& control) {
  OptimiserResult result;
  const bool simplex = options.search == LocalSearch::sbplx;
  result.route = simplex ? "NLopt (SBPLX)" : start.size() > 1 ? "NLopt (BOBYQA)" : "NLopt (COBYLA)";
  result.coordinates = start;
  result.cost = kRefused;
  const std::vector<double> lower = problem.parametrisation().lower();
  const std::vector<double> upper = problem.parametrisation().upper();
  const auto dimension = static_cast<unsigned>(start.size());
  double shrink = 1.0;
  for (int run = 0; run <= options.restarts && !result.interrupted; ++run, shrink *= kShorterStep) {
    nlopt::opt optimiser(simplex         ? nlopt::LN_SBPLX
                         : dimension > 1 ? nlopt::LN_BOBYQA
                                         : nlopt::LN_COBYLA,
                         dimension);
    optimiser.set_lower_bounds(lower);
    optimiser.set_upper_bounds(upper);
    std::vector<double> steps;
    for (std::size_t k = 0; k < start.size(); ++k) {
      const Coordinate& coordinate = problem.parametrisation().coordinates()[k];
      const double step = coordinate.logarithmic ? options.first_step
                          : coordinate.effect    ? options.first_step_effect
                                                 : options.first_step_C_1;
      // BOBYQA wants room for its first step on one side at least
      steps.push_back(std::min(shrink * step, 0.45 * (upper[k] - lower[k])));
    }
    optimiser.set_initial_step(steps);
    optimiser.set_xtol_abs(options.coordinate_tolerance);
    if (options.cost_tolerance > 0.0) optimiser.set_ftol_rel(options.cost_tolerance);
    optimiser.set_maxeval(options.max_evaluations - result.evaluations);
    run_once(optimiser, problem, control, result);
    if (result.evaluations >= options.max_evaluations) break;
  }
  return result;
}

}  // namespace isotach::calibration
