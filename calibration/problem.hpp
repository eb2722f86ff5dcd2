// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of a fit: experiments, coordinates, and the evaluation of both at a point.
#pragma once

#include <memory>
#include <vector>

#include "calibration/parametrisation.hpp"
#include "experiments/experiment.hpp"

namespace isotach::calibration {

using Experiments = std::vector<std::shared_ptr<const experiments::Experiment>>;

/// Residuals of a set of experiments at one point, in units of their noise.
struct Evaluation {
  std::vector<experiments::Values> scaled_residuals;  ///< by experiment
  /// Half the sum of squares over all.
  [[nodiscard]] double cost() const;
};

/// Residuals of all experiments stacked, and their derivatives with respect to the coordinates.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

class Problem {
 public:
  /// `experiments` as a study lists them; those held out take no part. `threads` >= 1 experiments run at
  /// once.
  Problem(const Experiments& experiments, Parametrisation parametrisation, int threads);

  [[nodiscard]] const Parametrisation& parametrisation() const { return parametrisation_; }
  [[nodiscard]] const Experiments& fitted() const { return fitted_; }
  [[nodiscard]] std::size_t residual_count() const { return residual_count_; }
  [[nodiscard]] int threads() const { return threads_; }

  [[nodiscard]] tl::expected<Evaluation, experiments::PredictionFailure> evaluate(
      const std::vector<double>& x) const;
  [[nodiscard]] tl::expected<Linearised, experiments::PredictionFailure> linearise(
      const std::vector<double>& x) const;

 private:
  Experiments fitted_;
  Parametrisation parametrisation_;
  std::size_t residual_count_ = 0;
  int threads_;
};

/// Predictions of all `experiments` at `parameters`, as many at once as `threads`; the first failure, if any.
[[nodiscard]] tl::expected<Evaluation, experiments::PredictionFailure> evaluate_all(
    const Experiments& experiments, const model::Parameters<double>& parameters, int threads);

}  // namespace isotach::calibration
