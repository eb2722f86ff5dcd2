// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of a fit: experiments, coordinates, weights, and the evaluation of all at a
// point.
#pragma once

#include <memory>
#include <vector>

#include "calibration/common_error.hpp"
#include "calibration/noise_model.hpp"
#include "calibration/parametrisation.hpp"
#include "experiments/experiment.hpp"

namespace isotach::calibration {

/// Residuals of a set of experiments at one point, in units of their noise.
struct Evaluation {
  std::vector<experiments::Values> scaled_residuals;  ///< by experiment
};

/// Weighted residuals of all experiments stacked, priors below them, and their derivatives by the
/// coordinates.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

/// How the residuals of one channel of an experiment are weighted.
struct ChannelWeights {
  std::vector<std::size_t> values;  ///< of the experiment
  Whitening whitening;
};

/// Of one experiment; without channels its residuals are divided by the noise that it states.
using ExperimentWeights = std::vector<ChannelWeights>;

class Problem {
 public:
  /// `experiments` as a study lists them, and as the parametrisation knows them; those held out take no part.
  /// `threads` >= 1 experiments run at once.
  Problem(const Experiments& experiments, Parametrisation parametrisation, int threads);

  [[nodiscard]] const Parametrisation& parametrisation() const { return parametrisation_; }
  [[nodiscard]] const Experiments& fitted() const { return fitted_; }
  /// Number of measured values fitted.
  [[nodiscard]] std::size_t value_count() const { return value_count_; }
  /// Number of residuals: values and priors.
  [[nodiscard]] std::size_t residual_count() const { return value_count_ + priors_.size(); }
  [[nodiscard]] int threads() const { return threads_; }
  void set_threads(int threads) { threads_ = threads; }
  /// Weights of each fitted experiment.
  void set_weights(std::vector<ExperimentWeights> weights) { weights_ = std::move(weights); }
  /// What the fitted experiments' residuals share beyond what each experiment's own noise says.
  void set_common_error(CommonError error) { common_ = std::move(error); }
  [[nodiscard]] const CommonError& common_error() const { return common_; }

  /// The same problem with other experiments in the place of fitted(), of the same sizes.
  [[nodiscard]] Problem with_fitted(Experiments experiments) const {
    Problem result = *this;
    result.fitted_ = std::move(experiments);
    return result;
  }

  /// Residuals of each fitted experiment in units of the noise that it states.
  [[nodiscard]] tl::expected<Evaluation, experiments::PredictionFailure> evaluate(
      const std::vector<double>& x) const;
  /// Weighted residuals, priors below. Half the sum of their squares is the cost.
  [[nodiscard]] tl::expected<Eigen::VectorXd, experiments::PredictionFailure> residuals(
      const std::vector<double>& x) const;
  [[nodiscard]] tl::expected<Linearised, experiments::PredictionFailure> linearise(
      const std::vector<double>& x) const;
  /// The same of predictions that were made at x.
  [[nodiscard]] Linearised linearised(const std::vector<double>& x,
                                      const std::vector<experiments::Linearisation>& predictions) const;
  /// Predictions of each fitted experiment with their derivatives by the coordinates, not weighted.
  [[nodiscard]] tl::expected<std::vector<experiments::Linearisation>, experiments::PredictionFailure>
  predictions(const std::vector<double>& x) const;
  /// Residuals of predictions of each fitted experiment, and their derivatives, weighted as those of
  /// linearise(); without priors.
  [[nodiscard]] Linearised weighted(const std::vector<experiments::Linearisation>& predictions) const;

 private:
  void weigh(std::size_t fitted, Eigen::Ref<Eigen::MatrixXd> block) const;
  void append_priors(const std::vector<double>& x, Eigen::VectorXd& residuals,
                     Eigen::MatrixXd* jacobian) const;

  Experiments fitted_;
  std::vector<std::size_t> index_;  // of each fitted one among all
  Parametrisation parametrisation_;
  std::vector<std::size_t> priors_;  // coordinates that have one
  std::vector<ExperimentWeights> weights_;
  CommonError common_;
  std::size_t value_count_ = 0;
  int threads_;
};

/// Indices in the order in which threads should take experiments up, so that none waits for a costly one at
/// the end.
[[nodiscard]] std::vector<std::size_t> by_cost(const Experiments& experiments);

/// Half the sum of squares.
[[nodiscard]] inline double cost_of(const Eigen::VectorXd& residuals) {
  return 0.5 * residuals.squaredNorm();
}

/// Predictions of all `experiments` at `parameters`, as many at once as `threads`; the first failure, if any.
/// `locals` has the local quantities of each; where it is empty they are the study's.
[[nodiscard]] tl::expected<Evaluation, experiments::PredictionFailure> evaluate_all(
    const Experiments& experiments, const model::Parameters<double>& parameters,
    const std::vector<std::vector<double>>& locals, int threads);

}  // namespace isotach::calibration
