// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/shared_noise.hpp"

#include <cmath>
#include <stdexcept>

#include "calibration/restricted_likelihood.hpp"

namespace isotach::calibration {

namespace {

/// The channels one after the other; none correlates with another.
Channel joined(const std::vector<const Channel*>& channels) {
  Eigen::Index count = 0;
  for (const Channel* channel : channels) count += channel->residuals.size();
  const bool has_floor = channels.front()->inverse_stress.size() > 0;
  Channel all;
  all.residuals.resize(count);
  all.jacobian.resize(count, channels.front()->jacobian.cols());
  all.inverse_stress.resize(has_floor ? count : 0);
  all.known_variance.resize(count);
  Eigen::Index first = 0;
  for (const Channel* channel : channels) {
    const Eigen::Index own = channel->residuals.size();
    all.residuals.segment(first, own) = channel->residuals;
    all.jacobian.middleRows(first, own) = channel->jacobian;
    if (has_floor) all.inverse_stress.segment(first, own) = channel->inverse_stress;
    all.known_variance.segment(first, own) = channel->known_variance;
    for (const std::size_t start : channel->chain_starts) {
      all.chain_starts.push_back(static_cast<std::size_t>(first) + start);
    }
    first += own;
  }
  return all;
}

/// -2 times the restricted log-likelihood of all channels, each with its own noise.
double by_own_noise(const std::vector<const Channel*>& channels, const std::vector<NoiseModel>& own,
                    Eigen::MatrixXd information, Eigen::VectorXd gradient) {
  double value = 0.0;
  for (std::size_t k = 0; k + 1 < channels.size(); ++k) {
    const Whitening whitening(own[k], *channels[k]);
    Eigen::MatrixXd jacobian = channels[k]->jacobian;
    Eigen::MatrixXd residuals = channels[k]->residuals;
    whitening.whiten(jacobian);
    whitening.whiten(residuals);
    information += jacobian.transpose() * jacobian;
    gradient += jacobian.transpose() * residuals;
    value += whitening.log_determinant() + residuals.squaredNorm();
  }
  const NoiseModel& last = own.back();
  return value + RestrictedLikelihood(*channels.back(), information, gradient, last)
                     .at(last.level, last.floor, last.rho, last.serial_share);
}

}  // namespace

std::optional<NoiseModel> shared_noise(const std::vector<const Channel*>& channels,
                                       const std::vector<NoiseModel>& own,
                                       const Eigen::MatrixXd& other_information,
                                       const Eigen::VectorXd& other_gradient, NoiseParts parts) {
  if (channels.empty() || own.size() != channels.size()) {
    throw std::invalid_argument("a noise to share among no channels, or not one noise for each");
  }
  const Channel all = joined(channels);
  const NoiseModel shared = estimate_noise(all, other_information, other_gradient, own.front(), parts);
  // level, rho, share and, where there is one, floor
  const double numbers = all.inverse_stress.size() > 0 ? 4.0 : 3.0;
  const double more = numbers * static_cast<double>(channels.size() - 1);
  const double price = more * std::log(static_cast<double>(all.residuals.size()));
  const double separate = by_own_noise(channels, own, other_information, other_gradient);
  if (separate + price < -2.0 * shared.log_likelihood) return std::nullopt;
  return shared;
}

}  // namespace isotach::calibration
