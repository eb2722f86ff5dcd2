// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The noise of every channel of a problem, estimated from its residuals, and the weights that follow.
#pragma once

#include <string>
#include <vector>

#include "calibration/problem.hpp"

namespace isotach::calibration {

/// The noise of one channel of a fitted test.
struct ChannelNoise {
  std::string test;
  std::string quantity;
  std::size_t count = 0;  ///< values
  NoiseModel model;
  /// Correlated beyond kMisfitCorrelation: no noise of an instrument, but what the model misses.
  bool misfit = false;
  bool estimated = false;  ///< else as stated: too few values to estimate it from
  double stated_level = 0.0;
  double stated_floor = 0.0;  ///< Pa
};

/// Lag-1 autocorrelation from which residuals are taken for misfit. To whiten them would be to fit the
/// differences of readings and to let the curve as a whole go where it likes; instead the readings are
/// weighted by the noise stated (in a scale that makes them of unit variance), and the correlation enters the
/// covariance alone.
inline constexpr double kMisfitCorrelation = 0.9;

struct NoiseFit {
  std::vector<ChannelNoise> channels;
  std::vector<ExperimentWeights> weights;  ///< of each fitted experiment
  double degrees = 0.0;                    ///< independent values less coordinates; at least 3
  /// A channel whose weighted residuals keep their correlation.
  struct Remaining {
    std::size_t fitted;               ///< test
    std::vector<std::size_t> values;  ///< of the test
    std::vector<std::size_t> chains;  ///< where a series begins anew
    double rho;             ///< of an autoregression alone: what has a white part beside it lasts less
    Eigen::VectorXd ratio;  ///< estimated over weighting standard deviation, >= 1
  };
  std::vector<Remaining> remaining;  ///< of channels that are misfit
};

/// What the noise of tests may be.
struct NoiseKind {
  NoiseParts parts = NoiseParts::lasting;
  /// Channels whose noise is stated alike were read by one apparatus and have one noise, unless their
  /// residuals say otherwise (shared_noise).
  bool shared = false;
};

/// Restricted maximum likelihood of level, floor and correlation of each channel at x, the others' given, in
/// turn until they stand still.
[[nodiscard]] tl::expected<NoiseFit, experiments::PredictionFailure> fit_noise(const Problem& problem,
                                                                               const std::vector<double>& x,
                                                                               NoiseKind kind = {});

/// The covariance of an answer whose weighted residuals keep the correlations of `noise.remaining`:
/// C J' S J C, C the `covariance` that independent residuals would have, S theirs.
[[nodiscard]] Eigen::MatrixXd with_remaining_correlation(const Problem& problem, const Linearised& at,
                                                         const NoiseFit& noise,
                                                         const Eigen::MatrixXd& covariance);

}  // namespace isotach::calibration
