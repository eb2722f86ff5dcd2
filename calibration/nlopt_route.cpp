// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The route by NLopt: BOBYQA, without derivatives.
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
    if (control.stop != nullptr && control.stop->load()) {
      result.interrupted = true;
      optimiser.force_stop();
      return kRefused;
    }
    ++result.evaluations;
    const auto evaluation = problem.evaluate(x);
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
    const double cost = evaluation->cost();
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

}  // namespace

OptimiserResult minimise_with_nlopt(const Problem& problem, const std::vector<double>& start,
                                    const NloptOptions& options, const OptimiserControl& control) {
  OptimiserResult result;
  result.route = start.size() > 1 ? "NLopt (BOBYQA)" : "NLopt (COBYLA)";
  result.coordinates = start;
  result.cost = kRefused;
  const Parametrisation& parametrisation = problem.parametrisation();
  const auto dimension = static_cast<unsigned>(start.size());
  double shrink = 1.0;
  for (int run = 0; run <= options.restarts && !result.interrupted; ++run, shrink *= kShorterStep) {
    nlopt::opt optimiser(dimension > 1 ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, dimension);
    Search search{problem, control, result, optimiser};
    optimiser.set_min_objective(objective, &search);
    optimiser.set_lower_bounds(parametrisation.lower());
    optimiser.set_upper_bounds(parametrisation.upper());
    std::vector<double> steps;
    for (std::size_t k = 0; k < start.size(); ++k) {
      const double step = parametrisation.logarithmic(k) ? options.first_step : options.first_step_C_1;
      // BOBYQA wants room for its first step on one side at least
      steps.push_back(
          std::min(shrink * step, 0.45 * (parametrisation.upper()[k] - parametrisation.lower()[k])));
    }
    optimiser.set_initial_step(steps);
    optimiser.set_xtol_abs(options.coordinate_tolerance);
    if (options.cost_tolerance > 0.0) optimiser.set_ftol_rel(options.cost_tolerance);
    optimiser.set_maxeval(options.max_evaluations - result.evaluations);
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
    if (result.evaluations >= options.max_evaluations) break;
  }
  return result;
}

}  // namespace isotach::calibration
