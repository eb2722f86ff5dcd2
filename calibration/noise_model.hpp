// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The noise of one channel of a test: its level, floor and correlation estimated from residuals, and
// residuals freed of it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "calibration/serial_filter.hpp"

namespace isotach::calibration {

/// One series of n residuals with a common noise, in the order of reading, linearised in the p coordinates of
/// a fit.
struct Channel {
  Eigen::VectorXd residuals;              ///< n, predicted - measured (ln stress, or strain)
  Eigen::MatrixXd jacobian;               ///< n x p, d residuals/d coordinates
  Eigen::VectorXd inverse_stress;         ///< n, 1/stress (1/Pa), > 0; empty where the channel has no floor
  Eigen::VectorXd known_variance;         ///< n, >= 0, of the unit of residuals^2: what is known and stays
  std::vector<std::size_t> chain_starts;  ///< where a chain of correlation starts; 0 first, increasing
};

/// Noise with standard deviations sd_i^2 = level^2 + (floor inverse_stress_i)^2 + known_variance_i, the sum
/// of a part that lasts (first-order autoregressive) and a white one: values i and j of one chain have the
/// correlation serial_share rho^|i - j|, those of different chains none.
struct NoiseModel {
  double level = 0.0;           ///< of the unit of the residuals, >= 0
  double floor = 0.0;           ///< Pa, >= 0; 0 where the channel has none
  double rho = 0.0;             ///< in [0, kLargestRho]
  double log_likelihood = 0.0;  ///< restricted, but for -(n - p)/2 ln(2 pi); what estimate_noise maximised
  /// Independent values that would tell a constant as well as these: 1'R^-1 1, R their correlation; with
  /// serial_share 1 (m - (m - 2) rho)/(1 + rho) for a chain of m, summed over chains; from 1 a chain to m.
  double effective_count = 0.0;
  double serial_share = 1.0;  ///< of each value's variance that lasts, in [0, 1]; the rest is white

  /// Correlation of neighbours of a chain.
  [[nodiscard]] double neighbours() const { return serial_share * rho; }
  /// Variance of the mean of many neighbours, over that of as many independent values.
  [[nodiscard]] double of_mean() const {
    return 1.0 - serial_share + serial_share * (1.0 + rho) / (1.0 - rho);
  }
};

/// What a noise may be made of.
enum class NoiseParts {
  lasting,           ///< an autoregression alone: serial_share is 1
  lasting_and_white  ///< and a white part, where it is worth its price
};

/// Beyond this a chain of some hundred values is a random walk, which an offset explains as well.
inline constexpr double kLargestRho = 0.995;
/// Largest rho of a part that lasts beside a white one. Nearly everything that a model misses is slow, and
/// beside the scatter of readings it looks like such a part: were it given all of that, no misfit would be
/// left to see. A part that lasts longer than ten readings is therefore not taken for noise.
inline constexpr double kLargestSplitRho = 0.9;
/// What a white part has to gain in -2 ln(likelihood) over the autoregression alone: two, the price of one
/// more number by Akaike (1974). Where the data do not pay it they do not tell the two apart.
inline constexpr double kSplitGain = 2.0;

/// Estimates the noise of a channel by restricted maximum likelihood (Patterson & Thompson 1971): maximises
///   -1/2 [ sum ln sd_i^2 + ln det R + ln det(J' S^-1 J + H) + Q ],
///   Q = min over dx of (r + J dx)' S^-1 (r + J dx) + dx' H dx + 2 g' dx,
/// S the covariance that the model makes of R and sd, so that the coordinates which a fit takes from the same
/// data are accounted for, as n - p accounts for them in the variance about a straight line. The other
/// channels of the fit enter by H = `other_information` (p x p, the sum of their J' S^-1 J) and g =
/// `other_gradient` (p, of their J' S^-1 r), both at the point where the residuals are taken.
///
/// Directions of dx that neither this channel nor the others see (eigenvalue below 1e-12 of the largest, each
/// coordinate scaled to unit information, noise as in `start`) are left out of determinant and minimum.
///
/// level lies within 1e-4 and 10 times the residuals' root mean square, floor times inverse_stress too.
/// Either is exactly 0 where leaving it out costs less than 1e-3 of log-likelihood and the other sources
/// leave every sd_i > 0. rho is searched within [0, kLargestRho] on the whole range; level and floor from
/// `start` and from two places of their own, so that a bad `start` does no harm. First serial_share is 1;
/// then, with rho up to kLargestSplitRho, the share is sought too, and kept where it gains kSplitGain.
///
/// A known_variance larger than the scatter there is shows as correlation: rho is the only thing left that
/// makes the innovations small.
///
/// Throws std::invalid_argument for sizes that do not agree, numbers that are not finite or out of the ranges
/// stated, chain_starts that do not begin with 0 and increase below n, no more values than coordinates that
/// this channel sees, and residuals all zero where `start` has no noise either.
[[nodiscard]] NoiseModel estimate_noise(const Channel& channel, const Eigen::MatrixXd& other_information,
                                        const Eigen::VectorXd& other_gradient, const NoiseModel& start,
                                        NoiseParts parts = NoiseParts::lasting_and_white);

/// NoiseModel::effective_count of a noise for a channel.
[[nodiscard]] double effective_count(const NoiseModel& model, const Channel& channel);

/// Frees values of a channel of its noise: r/sd, then the innovations of SerialFilter; with serial_share 1,
/// r_i' = (r_i/sd_i - rho r_{i-1}/sd_{i-1})/sqrt(1 - rho^2), the first of a chain r/sd. Residuals of that
/// noise become independent, of unit variance.
class Whitening {
 public:
  /// Of the channel its residuals and Jacobian do not enter. Throws std::invalid_argument as estimate_noise
  /// does, for a model out of its ranges, and where some sd_i is 0.
  Whitening(const NoiseModel& model, const Channel& channel);

  /// Of each column, in place; a vector is a matrix of one column. Throws std::invalid_argument for another
  /// number of rows than the channel has values.
  void whiten(Eigen::Ref<Eigen::MatrixXd> values) const;

  /// Standard deviation of each value.
  [[nodiscard]] const Eigen::VectorXd& sd() const { return sd_; }
  /// ln det S.
  [[nodiscard]] double log_determinant() const { return log_determinant_; }

 private:
  Eigen::VectorXd sd_;
  SerialFilter filter_;
  double log_determinant_;
};

}  // namespace isotach::calibration
