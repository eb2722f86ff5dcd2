// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The route by Ceres: nonlinear least squares with the exact Jacobian.
#include <ceres/ceres.h>

#include <algorithm>
#include <limits>

#include "calibration/optimisers.hpp"

namespace isotach::calibration {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The residuals as a function of the coordinates that move; the others stay where the start has them.
class Residuals final : public ceres::CostFunction {
 public:
  Residuals(const Problem& problem, const std::vector<double>& start, const std::vector<std::size_t>& moving,
            OptimiserResult& result)
      : problem_(problem), start_(start), moving_(moving), result_(result) {
    set_num_residuals(static_cast<int>(problem.residual_count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(moving.size()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    std::vector<double> x = start_;
    for (std::size_t k = 0; k < moving_.size(); ++k) x[moving_[k]] = blocks[0][k];
    // Ceres asks for the residuals of a trial point and, once it is accepted, for both. The derivatives cost
    // little more than the residuals, so they are taken at once and kept.
    if (x != at_) {
      ++result_.evaluations;
      auto linearised = problem_.linearise(x);
      if (!linearised) return refuse(linearised.error());
      linearised_ = std::move(*linearised);
      at_ = std::move(x);
    }
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = linearised_.residuals;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<RowMajor> jacobian(jacobians[0], num_residuals(), static_cast<Eigen::Index>(moving_.size()));
      for (std::size_t k = 0; k < moving_.size(); ++k) {
        jacobian.col(static_cast<Eigen::Index>(k)) =
            linearised_.jacobian.col(static_cast<Eigen::Index>(moving_[k]));
      }
    }
    return true;
  }

 private:
  // Ceres takes false as "no step there" and shortens it.
  bool refuse(const experiments::PredictionFailure& failure) const {
    if (!failure.interrupted) ++result_.failed_evaluations;
    result_.last_failure = failure.message;
    return false;
  }

  const Problem& problem_;
  const std::vector<double>& start_;
  const std::vector<std::size_t>& moving_;
  OptimiserResult& result_;
  mutable std::vector<double> at_;  // where linearised_ was taken
  mutable Linearised linearised_;
};

class Watch final : public ceres::IterationCallback {
 public:
  Watch(OptimiserResult& result, const std::vector<double>& moved, const std::vector<std::size_t>& moving,
        const OptimiserControl& control)
      : result_(result), moved_(moved), moving_(moving), control_(control) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.step_is_successful || summary.iteration == 0) {
      std::vector<double> x = result_.coordinates;
      for (std::size_t k = 0; k < moving_.size(); ++k) x[moving_[k]] = moved_[k];
      result_.trace.push_back({result_.evaluations, summary.cost, std::move(x)});
    }
    if (control_.callback) control_.callback(result_.evaluations, summary.cost);
    const bool stop = control_.stopped();
    return stop ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  OptimiserResult& result_;
  const std::vector<double>& moved_;
  const std::vector<std::size_t>& moving_;
  const OptimiserControl& control_;
};

/// One solve, from result.coordinates, of the coordinates in `moving`.
void solve(const Problem& problem, const std::vector<std::size_t>& moving, const CeresOptions& options,
           const OptimiserControl& control, OptimiserResult& result) {
  const std::vector<double> start = result.coordinates;
  std::vector<double> x;
  for (const std::size_t k : moving) x.push_back(start[k]);
  ceres::Problem least_squares;
  least_squares.AddResidualBlock(new Residuals(problem, start, moving, result), nullptr, x.data());
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const Coordinate& coordinate = problem.parametrisation().coordinates()[moving[k]];
    least_squares.SetParameterLowerBound(x.data(), static_cast<int>(k), coordinate.lower);
    least_squares.SetParameterUpperBound(x.data(), static_cast<int>(k), coordinate.upper);
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.parameter_tolerance = options.parameter_tolerance;
  solver.gradient_tolerance = 0.0;  // the gradient's size depends on the number of data
  solver.num_threads = 1;           // experiments already run in parallel
  solver.logging_type = ceres::SILENT;
  solver.update_state_every_iteration = true;
  Watch watch(result, x, moving, control);
  solver.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &least_squares, &summary);
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.interrupted = summary.termination_type == ceres::USER_FAILURE;
  result.termination = summary.message;
  for (std::size_t k = 0; k < moving.size(); ++k) result.coordinates[moving[k]] = x[k];
  result.cost = summary.final_cost;
}

}  // namespace

OptimiserResult minimise_with_ceres(const Problem& problem, const std::vector<double>& start,
                                    const CeresOptions& options, const OptimiserControl& control) {
  OptimiserResult result;
  result.route = "Ceres (Levenberg-Marquardt)";
  result.coordinates = problem.parametrisation().inside(start);
  const auto is_held = [&](std::size_t k) {
    return std::find(options.held.begin(), options.held.end(), k) != options.held.end();
  };
  std::vector<std::size_t> moving;
  for (std::size_t k = 0; k < start.size(); ++k) {
    if (!is_held(k)) moving.push_back(k);
  }
  // Ceres logs to standard error where the first evaluation fails; the caller hears it from the result
  const auto first = problem.residuals(result.coordinates);
  if (!first || moving.empty()) {
    result.evaluations = 1;
    result.converged = first.has_value();
    result.cost = first ? cost_of(*first) : std::numeric_limits<double>::infinity();
    if (!first) {
      result.failed_evaluations = 1;
      result.interrupted = first.error().interrupted;
      result.termination = result.last_failure = first.error().message;
    }
    return result;
  }
  solve(problem, moving, options, control, result);
  // With a step cut at a bound the others stop short: they go on while that one stays.
  std::vector<std::size_t> inner;
  for (const std::size_t k : moving) {
    if (!problem.parametrisation().at_bound(result.coordinates, k)) inner.push_back(k);
  }
  if (!result.interrupted && inner.size() < moving.size() && !inner.empty()) {
    solve(problem, inner, options, control, result);
    // and all once more, lest the bound no longer holds
    if (!result.interrupted) solve(problem, moving, options, control, result);
  }
  return result;
}

}  // namespace isotach::calibration
