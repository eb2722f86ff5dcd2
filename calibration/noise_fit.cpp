// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/noise_fit.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/shared_noise.hpp"

namespace isotach::calibration {

namespace {

/// Information and gradient of some residuals.
struct Quadratic {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
};

/// A channel with its place in the problem.
struct Placed {
  std::size_t fitted;
  std::vector<std::size_t> values;
  Channel channel;
  ChannelNoise noise;
};

Quadratic quadratic_of(const Placed& placed) {
  const Eigen::Index columns = placed.channel.jacobian.cols();
  Eigen::MatrixXd both(placed.channel.jacobian.rows(), columns + 1);
  both << placed.channel.jacobian, placed.channel.residuals;
  Whitening(placed.noise.model, placed.channel).whiten(both);
  const auto jacobian = both.leftCols(columns);
  return {jacobian.transpose() * jacobian, jacobian.transpose() * both.col(columns)};
}

Quadratic priors_of(const Problem& problem, const std::vector<double>& x) {
  const auto size = static_cast<Eigen::Index>(x.size());
  Quadratic result{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto& prior = problem.parametrisation().coordinates()[k].prior;
    if (!prior) continue;
    const auto i = static_cast<Eigen::Index>(k);
    const double weight = 1.0 / (prior->std_error * prior->std_error);
    result.information(i, i) = weight;
    result.gradient[i] = weight * (x[k] - prior->mean);
  }
  return result;
}

std::vector<Placed> place_channels(const Problem& problem,
                                   const std::vector<experiments::Linearisation>& predictions) {
  std::vector<Placed> all;
  for (std::size_t i = 0; i < problem.fitted().size(); ++i) {
    const experiments::Experiment& experiment = *problem.fitted()[i];
    for (experiments::Channel& from : experiment.channels()) {
      Placed placed;
      placed.fitted = i;
      const auto count = static_cast<Eigen::Index>(from.values.size());
      placed.channel.residuals.resize(count);
      placed.channel.jacobian.resize(count, predictions[i].jacobian.cols());
      for (Eigen::Index row = 0; row < count; ++row) {
        const std::size_t value = from.values[static_cast<std::size_t>(row)];
        placed.channel.residuals[row] = predictions[i].values[value] - experiment.measured()[value];
        placed.channel.jacobian.row(row) = predictions[i].jacobian.row(static_cast<Eigen::Index>(value));
      }
      placed.channel.inverse_stress = std::move(from.inverse_stress);
      placed.channel.known_variance = std::move(from.known_variance);
      placed.channel.chain_starts = from.chains;
      placed.noise.test = experiment.name();
      placed.noise.quantity = from.quantity;
      placed.noise.count = from.values.size();
      placed.noise.stated_level = placed.noise.model.level = from.stated_level;
      placed.noise.stated_floor = placed.noise.model.floor = from.stated_floor;
      placed.noise.model.effective_count = static_cast<double>(from.values.size());
      placed.values = std::move(from.values);
      all.push_back(std::move(placed));
    }
  }
  return all;
}

/// The sum but for some channels.
Quadratic without(Quadratic sum, const std::vector<Quadratic>& all,
                  const std::vector<std::size_t>& left_out) {
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (std::find(left_out.begin(), left_out.end(), c) != left_out.end()) continue;
    sum.information += all[c].information;
    sum.gradient += all[c].gradient;
  }
  return sum;
}

/// Groups of two channels and more whose noise is estimated and was stated alike.
std::vector<std::vector<std::size_t>> stated_alike(const std::vector<Placed>& all) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (!all[c].noise.estimated) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      const ChannelNoise& other = all[group.front()].noise;
      return other.quantity == all[c].noise.quantity && other.stated_level == all[c].noise.stated_level &&
             other.stated_floor == all[c].noise.stated_floor;
    });
    if (same == groups.end()) {
      groups.push_back({c});
    } else {
      same->push_back(c);
    }
  }
  std::erase_if(groups, [](const auto& group) { return group.size() < 2; });
  return groups;
}

/// Gives channels one noise unless their residuals say otherwise.
void share_noise(std::vector<Placed>& all, const std::vector<std::size_t>& alike, const Quadratic& others,
                 NoiseParts parts) {
  std::vector<const Channel*> channels;
  std::vector<NoiseModel> own;
  for (const std::size_t c : alike) {
    channels.push_back(&all[c].channel);
    own.push_back(all[c].noise.model);
  }
  const auto shared = shared_noise(channels, own, others.information, others.gradient, parts);
  if (!shared) return;
  for (const std::size_t c : alike) {
    all[c].noise.model = *shared;
    all[c].noise.model.effective_count = effective_count(*shared, all[c].channel);
  }
}

/// Weights by the noise stated, in the scale that makes the residuals' mean square one: over `degrees` of
/// them, and no smaller than `least`.
Whitening by_stated_noise(const Placed& placed, double degrees, double least) {
  NoiseModel stated;
  stated.level = placed.noise.stated_level;
  stated.floor = placed.channel.inverse_stress.size() > 0 ? placed.noise.stated_floor : 0.0;
  const Eigen::VectorXd sd = Whitening(stated, placed.channel).sd();
  const double scale =
      std::max(least, std::sqrt(placed.channel.residuals.cwiseQuotient(sd).squaredNorm() / degrees));
  Channel scaled = placed.channel;
  scaled.known_variance *= scale * scale;
  stated.level *= scale;
  stated.floor *= scale;
  return {stated, scaled};
}

}  // namespace

tl::expected<NoiseFit, experiments::PredictionFailure> fit_noise(const Problem& problem,
                                                                 const std::vector<double>& x,
                                                                 NoiseKind kind) {
  const auto predictions = problem.predictions(x);
  if (!predictions) return tl::unexpected(predictions.error());
  std::vector<Placed> all = place_channels(problem, *predictions);
  constexpr std::size_t kFewest = 12;  // values beyond the coordinates from which three numbers can be had
  for (Placed& placed : all) {
    placed.noise.estimated = placed.values.size() >= x.size() + kFewest;
  }

  const Quadratic priors = priors_of(problem, x);
  std::vector<Quadratic> quadratics;
  for (const Placed& placed : all) quadratics.push_back(quadratic_of(placed));
  const int sweeps = all.size() > 1 ? 3 : 1;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t c = 0; c < all.size(); ++c) {
      if (!all[c].noise.estimated) continue;
      const Quadratic others = without(priors, quadratics, {c});
      all[c].noise.model =
          estimate_noise(all[c].channel, others.information, others.gradient, all[c].noise.model, kind.parts);
      quadratics[c] = quadratic_of(all[c]);
    }
  }
  if (kind.shared) {
    for (const std::vector<std::size_t>& alike : stated_alike(all)) {
      share_noise(all, alike, without(priors, quadratics, alike), kind.parts);
      for (const std::size_t c : alike) quadratics[c] = quadratic_of(all[c]);
    }
  }

  NoiseFit fit;
  fit.weights.resize(problem.fitted().size());
  double independent = 0.0;
  for (Placed& placed : all) {
    independent += placed.noise.model.effective_count;
    placed.noise.misfit = placed.noise.model.neighbours() > kMisfitCorrelation;
    Whitening whitening(placed.noise.model, placed.channel);
    if (placed.noise.misfit) {
      const Eigen::VectorXd estimated = whitening.sd();
      constexpr double kAnyScale = 1e-12;
      whitening = by_stated_noise(placed, static_cast<double>(placed.values.size()), kAnyScale);
      fit.remaining.push_back({placed.fitted, placed.values, placed.channel.chain_starts,
                               placed.noise.model.rho,
                               estimated.cwiseQuotient(whitening.sd()).cwiseMax(1.0)});
    }
    if (!placed.noise.estimated) {
      // too few values for a noise of their own, but enough to see that they are missed by more than stated
      const double degrees = static_cast<double>(placed.values.size()) - static_cast<double>(x.size());
      whitening = by_stated_noise(placed, std::max(1.0, degrees), 1.0);
    }
    fit.weights[placed.fitted].push_back({std::move(placed.values), std::move(whitening)});
    fit.channels.push_back(std::move(placed.noise));
  }
  constexpr double kFewestDegrees = 3.0;
  fit.degrees = std::max(kFewestDegrees, independent - static_cast<double>(x.size()));
  return fit;
}

Eigen::MatrixXd with_remaining_correlation(const Problem& problem, const Linearised& at,
                                           const NoiseFit& noise, const Eigen::MatrixXd& covariance) {
  if (noise.remaining.empty()) return covariance;
  std::vector<Eigen::Index> first_row{0};
  for (const auto& experiment : problem.fitted()) {
    first_row.push_back(first_row.back() + static_cast<Eigen::Index>(experiment->measured().size()));
  }
  // J'J of the channels that are white, J' S J of the others
  Eigen::MatrixXd middle = at.jacobian.transpose() * at.jacobian;
  for (const NoiseFit::Remaining& channel : noise.remaining) {
    const auto count = static_cast<Eigen::Index>(channel.values.size());
    Eigen::MatrixXd part(count, at.jacobian.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
      part.row(i) = at.jacobian.row(first_row[channel.fitted] +
                                    static_cast<Eigen::Index>(channel.values[static_cast<std::size_t>(i)]));
    }
    middle -= part.transpose() * part;
    part.array().colwise() *= channel.ratio.array();
    // R v for R_ij = rho^|i - j|: what comes from before and from behind, the value itself counted once
    Eigen::MatrixXd before = part;
    Eigen::MatrixXd behind = part;
    std::vector<bool> opens(channel.values.size(), false);
    for (const std::size_t i : channel.chains) opens[i] = true;
    for (Eigen::Index i = 1; i < count; ++i) {
      if (!opens[static_cast<std::size_t>(i)]) before.row(i) += channel.rho * before.row(i - 1);
    }
    for (Eigen::Index i = count - 2; i >= 0; --i) {
      if (!opens[static_cast<std::size_t>(i) + 1]) behind.row(i) += channel.rho * behind.row(i + 1);
    }
    middle += part.transpose() * (before + behind - part);
  }
  return covariance * middle * covariance;
}

}  // namespace isotach::calibration
