// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/block_bootstrap.hpp"
#include "calibration/parallel.hpp"

namespace isotach::calibration {

namespace {

/// An experiment with other readings.
class WithReadings final : public experiments::Experiment {
 public:
  WithReadings(std::shared_ptr<const experiments::Experiment> experiment, experiments::Values readings)
      : experiment_(std::move(experiment)), readings_(std::move(readings)) {}

  const std::string& name() const override { return experiment_->name(); }
  bool held_out() const override { return false; }
  const experiments::Values& measured() const override { return readings_; }
  std::string_view quantity() const override { return experiment_->quantity(); }
  const experiments::Values& noise() const override { return experiment_->noise(); }
  std::vector<experiments::Channel> channels() const override { return experiment_->channels(); }
  std::vector<experiments::LocalQuantity> locals() const override { return experiment_->locals(); }
  tl::expected<experiments::Values, experiments::PredictionFailure> predict(
      const model::Parameters<double>& parameters, std::span<const double> local) const override {
    return experiment_->predict(parameters, local);
  }
  tl::expected<experiments::Linearisation, experiments::PredictionFailure> linearise(
      const model::Parameters<double>& parameters, std::span<const double> local,
      const Eigen::MatrixXd& directions) const override {
    return experiment_->linearise(parameters, local, directions);
  }

 private:
  std::shared_ptr<const experiments::Experiment> experiment_;
  experiments::Values readings_;
};

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double place = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace

Bootstrap bootstrap(const Problem& problem, const NoiseFit& noise, const std::vector<double>& x,
                    const BootstrapOptions& options, const OptimiserControl& control) {
  Bootstrap result;
  result.samples = options.samples;
  const auto predictions = problem.predictions(x);
  if (!predictions) {
    result.failed = options.samples;
    return result;
  }
  std::vector<std::vector<std::size_t>> blocks;  // by fitted test and channel
  std::size_t next = 0;
  for (std::size_t i = 0; i < problem.fitted().size(); ++i) {
    blocks.emplace_back();
    for (const ChannelWeights& channel : noise.weights[i]) {
      const NoiseModel& model = noise.channels[next++].model;
      blocks[i].push_back(block_length(model.rho, channel.values.size(), model.serial_share));
      result.blocks.push_back(blocks[i].back());
    }
  }

  const auto count = static_cast<std::size_t>(options.samples);
  std::vector<std::optional<std::vector<double>>> answers(count);
  parallel_for(count, options.threads, [&](std::size_t sample) {
    if (control.stopped()) return;
    std::seed_seq seeds{options.seed, static_cast<unsigned>(sample)};
    std::mt19937_64 random(seeds);
    Experiments made;
    for (std::size_t i = 0; i < problem.fitted().size(); ++i) {
      const auto& experiment = problem.fitted()[i];
      experiments::Values readings = (*predictions)[i].values;
      for (std::size_t c = 0; c < noise.weights[i].size(); ++c) {
        const ChannelWeights& channel = noise.weights[i][c];
        const Eigen::VectorXd& sd = channel.whitening.sd();
        const auto drawn = resample_blocks(channel.values.size(), blocks[i][c], random);
        for (std::size_t k = 0; k < drawn.size(); ++k) {
          const std::size_t from = channel.values[drawn[k]];
          const double residual = (experiment->measured()[from] - (*predictions)[i].values[from]) /
                                  sd[static_cast<Eigen::Index>(drawn[k])];
          readings[channel.values[k]] += residual * sd[static_cast<Eigen::Index>(k)];
        }
      }
      made.push_back(std::make_shared<WithReadings>(experiment, std::move(readings)));
    }
    Problem resampled = problem.with_fitted(std::move(made));
    resampled.set_threads(1);
    OptimiserControl quiet;
    quiet.stop = control.stop;
    CeresOptions ceres;
    ceres.max_iterations = 30;
    ceres.function_tolerance = 1e-8;
    const OptimiserResult found = minimise_with_ceres(resampled, x, ceres, quiet);
    if (found.converged) answers[sample] = found.coordinates;
  });

  const auto size = static_cast<Eigen::Index>(x.size());
  result.mean = result.std_error = result.lower = result.upper = Eigen::VectorXd::Zero(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    std::vector<double> values;
    for (const auto& answer : answers) {
      if (answer) values.push_back((*answer)[static_cast<std::size_t>(k)]);
    }
    result.failed = options.samples - static_cast<int>(values.size());
    if (values.size() < 2) continue;
    // a copy: over memory of any alignment Eigen's sums would round differently from run to run
    const Eigen::ArrayXd all =
        Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    result.mean[k] = all.mean();
    result.std_error[k] =
        std::sqrt((all - all.mean()).square().sum() / static_cast<double>(values.size() - 1));
    result.lower[k] = quantile(values, 0.025);
    result.upper[k] = quantile(values, 0.975);
  }
  return result;
}

}  // namespace isotach::calibration
