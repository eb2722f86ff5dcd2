// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Two independent routes to the minimum: Ceres with exact Jacobians, NLopt without derivatives.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "calibration/problem.hpp"

namespace isotach::calibration {

/// The best point after an evaluation (or an iteration).
struct TracePoint {
  int evaluation;
  double cost;  ///< half the sum of squared residuals in units of noise
  std::vector<double> coordinates;
};

/// What the user hears while an optimiser runs: evaluations done, best cost so far.
using EvaluationCallback = std::function<void(int evaluations, double best_cost)>;

struct OptimiserControl {
  const std::atomic<bool>* stop = nullptr;
  EvaluationCallback callback;

  /// To be stopped by the same flag, and unheard.
  [[nodiscard]] OptimiserControl quiet() const { return {stop, {}}; }
  [[nodiscard]] bool stopped() const { return stop != nullptr && stop->load(); }
};

/// Of two costs, the difference that counts as one fit being better than the other.
inline constexpr double kBetterCost = 1e-3;

struct OptimiserResult {
  std::string route;  ///< "Ceres" or "NLopt" with the algorithm
  bool converged = false;
  bool interrupted = false;
  std::string termination;  ///< in the library's words
  std::vector<double> coordinates;
  double cost = 0.0;
  int evaluations = 0;
  long simulations = 0;        ///< of slump tests behind them, where they were counted; else 0
  int failed_evaluations = 0;  ///< predictions that could not be made; such points are refused
  std::string last_failure;
  std::vector<TracePoint> trace;  ///< every improvement
};

struct CeresOptions {
  int max_iterations = 100;
  double function_tolerance = 1e-12;
  double parameter_tolerance = 1e-10;
  std::vector<std::size_t> held{};  ///< coordinates that stay where they start
};

/// Levenberg-Marquardt with bounds, from `start`. Where a coordinate ends at its bound, the others are
/// brought to their minimum there. A start that cannot be predicted ends at once, with infinite cost.
[[nodiscard]] OptimiserResult minimise_with_ceres(const Problem& problem, const std::vector<double>& start,
                                                  const CeresOptions& options,
                                                  const OptimiserControl& control);

/// Local searches of NLopt within bounds.
enum class LocalSearch {
  bobyqa,  ///< quadratic models in a trust region; COBYLA for a single coordinate, which BOBYQA does not take
  sbplx    ///< Nelder and Mead's simplex on subspaces (Rowan 1990)
};

struct NloptOptions {
  LocalSearch search = LocalSearch::bobyqa;
  double first_step = 0.1;  ///< of logarithmic coordinates
  double first_step_C_1 = 0.05;
  double first_step_effect = 0.3;      ///< of an effect, in its typical values
  double coordinate_tolerance = 1e-6;  ///< absolute, of each coordinate
  double cost_tolerance = 0.0;         ///< relative
  int max_evaluations = 2000;
  int restarts = 0;  ///< further runs from the best point with smaller first steps
};

/// Global searches of NLopt within the bounds.
enum class GlobalSearch {
  crs2,   ///< controlled random search with local mutation
  isres,  ///< improved stochastic ranking evolution strategy
  esch,   ///< an evolutionary algorithm
  mlsl    ///< multi-level single linkage over low-discrepancy points, BOBYQA as the local search
};

[[nodiscard]] std::string_view name_of(GlobalSearch search);

struct GlobalOptions {
  int max_evaluations = 1500;
  std::vector<double> lower;  ///< of the box that is searched, within the problem's bounds
  std::vector<double> upper;
  unsigned seed = 1;
};

/// A global search, whose best point BOBYQA then polishes within the problem's bounds.
[[nodiscard]] OptimiserResult search_globally(const Problem& problem, GlobalSearch search,
                                              const std::vector<double>& start, const GlobalOptions& options,
                                              const OptimiserControl& control);

/// A local search from `start`.
[[nodiscard]] OptimiserResult minimise_with_nlopt(const Problem& problem, const std::vector<double>& start,
                                                  const NloptOptions& options,
                                                  const OptimiserControl& control);

}  // namespace isotach::calibration
