// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The route by Ceres: nonlinear least squares with the exact Jacobian.
#include <ceres/ceres.h>

#include "calibration/optimisers.hpp"

namespace isotach::calibration {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Residuals final : public ceres::CostFunction {
 public:
  Residuals(const Problem& problem, OptimiserResult& result) : problem_(problem), result_(result) {
    set_num_residuals(static_cast<int>(problem.residual_count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.parametrisation().free().size()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const auto count = static_cast<std::size_t>(parameter_block_sizes()[0]);
    const std::vector<double> x(blocks[0], blocks[0] + count);
    ++result_.evaluations;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      const auto linearised = problem_.linearise(x);
      if (!linearised) return refuse(linearised.error());
      Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = linearised->residuals;
      Eigen::Map<RowMajor>(jacobians[0], num_residuals(), static_cast<Eigen::Index>(count)) =
          linearised->jacobian;
      return true;
    }
    const auto evaluation = problem_.evaluate(x);
    if (!evaluation) return refuse(evaluation.error());
    for (const auto& values : evaluation->scaled_residuals)
      residuals = std::copy(values.begin(), values.end(), residuals);
    return true;
  }

 private:
  // Ceres takes false as "no step there" and shortens it.
  bool refuse(const experiments::PredictionFailure& failure) const {
    ++result_.failed_evaluations;
    result_.last_failure = failure.message;
    return false;
  }

  const Problem& problem_;
  OptimiserResult& result_;
};

class Watch final : public ceres::IterationCallback {
 public:
  Watch(OptimiserResult& result, const std::vector<double>& x, const OptimiserControl& control)
      : result_(result), x_(x), control_(control) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.step_is_successful || summary.iteration == 0) {
      result_.trace.push_back({result_.evaluations, summary.cost, x_});
    }
    if (control_.callback) control_.callback(result_.evaluations, summary.cost);
    const bool stop = control_.stop != nullptr && control_.stop->load();
    return stop ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  OptimiserResult& result_;
  const std::vector<double>& x_;
  const OptimiserControl& control_;
};

}  // namespace

OptimiserResult minimise_with_ceres(const Problem& problem, const std::vector<double>& start,
                                    const CeresOptions& options, const OptimiserControl& control) {
  OptimiserResult result;
  result.route = "Ceres (Levenberg-Marquardt)";
  std::vector<double> x = start;

  ceres::Problem least_squares;
  least_squares.AddResidualBlock(new Residuals(problem, result), nullptr, x.data());
  const Parametrisation& parametrisation = problem.parametrisation();
  for (std::size_t k = 0; k < x.size(); ++k) {
    least_squares.SetParameterLowerBound(x.data(), static_cast<int>(k), parametrisation.lower()[k]);
    least_squares.SetParameterUpperBound(x.data(), static_cast<int>(k), parametrisation.upper()[k]);
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
  Watch watch(result, x, control);
  solver.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &least_squares, &summary);

  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.interrupted = summary.termination_type == ceres::USER_FAILURE;
  result.termination = summary.message;
  result.coordinates = x;
  result.cost = summary.final_cost;
  return result;
}

}  // namespace isotach::calibration
