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
};

struct OptimiserResult {
  std::string route;  ///< "Ceres" or "NLopt" with the algorithm
  bool converged = false;
  bool interrupted = false;
  std::string termination;  ///< in the library's words
  std::vector<double> coordinates;
  double cost = 0.0;
  int evaluations = 0;
  int failed_evaluations = 0;  ///< predictions that could not be made; such points are refused
  std::string last_failure;
  std::vector<TracePoint> trace;  ///< every improvement
};

struct CeresOptions {
  int max_iterations = 100;
  double function_tolerance = 1e-12;
  double parameter_tolerance = 1e-10;
};

/// Levenberg-Marquardt with bounds, from `start`.
[[nodiscard]] OptimiserResult minimise_with_ceres(const Problem& problem, const std::vector<double>& start,
                                                  const CeresOptions& options,
                                                  const OptimiserControl& control);

struct NloptOptions {
  double first_step = 0.1;  ///< of logarithmic coordinates
  double first_step_C_1 = 0.05;
  double coordinate_tolerance = 1e-6;  ///< absolute, of each coordinate
  double cost_tolerance = 0.0;         ///< relative
  int max_evaluations = 2000;
  int restarts = 0;  ///< further runs from the best point with smaller first steps
};

/// BOBYQA (quadratic models in a trust region, bounds) from `start`; COBYLA for a single coordinate, which
/// BOBYQA does not take.
[[nodiscard]] OptimiserResult minimise_with_nlopt(const Problem& problem, const std::vector<double>& start,
                                                  const NloptOptions& options,
                                                  const OptimiserControl& control);

}  // namespace isotach::calibration
