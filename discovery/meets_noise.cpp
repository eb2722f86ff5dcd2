// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/meets_noise.hpp"

#include <algorithm>
#include <optional>

#include "calibration/distributions.hpp"
#include "discovery/limits.hpp"

namespace isotach::discovery {

namespace {

/// Least sum of squared correlations among a test's channels, of a value with those behind it, none taken to
/// last longer than kNoiseCorrelation has it; 0 where none could be estimated.
double squared_correlations_of(const calibration::NoiseFit& noise, const std::string& test) {
  std::optional<double> least;
  for (const calibration::ChannelNoise& channel : noise.channels) {
    if (channel.test != test || !channel.estimated) continue;
    const double rho = std::min(kNoiseCorrelation, channel.model.rho);
    const double sum = squared_correlations(rho, channel.model.serial_share);
    least = std::min(least.value_or(sum), sum);
  }
  return least.value_or(0.0);
}

}  // namespace

double squared_correlations(double rho, double serial_share) {
  return serial_share * serial_share * rho * rho / (1.0 - rho * rho);
}

double effective_count(double count, double squared_correlations) {
  return std::max(1.0, count / (1.0 + 2.0 * squared_correlations));
}

bool meets_noise(const calibration::OedometerFit& fit, const calibration::NoiseFit& noise) {
  for (std::size_t i = 0; i < fit.checks.size(); ++i) {
    const calibration::TestCheck& test = fit.checks[i];
    if (test.held_out) continue;
    if (fit.result.tests[i].rms_over_noise > calibration::kAdequate) return false;
    const double correlations = squared_correlations_of(noise, test.name);
    for (const calibration::StageCheck& stage : test.stages) {
      if (stage.rms_over_noise <= calibration::kStageMisfit) continue;
      const double count = effective_count(static_cast<double>(stage.count), correlations);
      const double squares = count * stage.rms_over_noise * stage.rms_over_noise;
      if (calibration::chi_squared_survival(squares, count) < kStageRare) return false;
    }
  }
  return true;
}

}  // namespace isotach::discovery
