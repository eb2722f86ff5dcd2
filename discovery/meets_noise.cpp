// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/meets_noise.hpp"

#include <algorithm>

#include "calibration/distributions.hpp"
#include "discovery/limits.hpp"

namespace isotach::discovery {

namespace {

/// The least correlation among a test's channels; 0 where none could be estimated.
double correlation_of(const calibration::NoiseFit& noise, const std::string& test) {
  double least = kNoiseCorrelation;
  bool any = false;
  for (const calibration::ChannelNoise& channel : noise.channels) {
    if (channel.test != test || !channel.estimated) continue;
    least = std::min(least, channel.model.rho);
    any = true;
  }
  return any ? least : 0.0;
}

}  // namespace

double effective_count(double count, double rho) {
  return std::max(1.0, count * (1.0 - rho * rho) / (1.0 + rho * rho));
}

bool meets_noise(const calibration::OedometerFit& fit, const calibration::NoiseFit& noise) {
  for (std::size_t i = 0; i < fit.checks.size(); ++i) {
    const calibration::TestCheck& test = fit.checks[i];
    if (test.held_out) continue;
    if (fit.result.tests[i].rms_over_noise > calibration::kAdequate) return false;
    const double rho = correlation_of(noise, test.name);
    for (const calibration::StageCheck& stage : test.stages) {
      if (stage.rms_over_noise <= calibration::kStageMisfit) continue;
      const double count = effective_count(static_cast<double>(stage.count), rho);
      const double squares = count * stage.rms_over_noise * stage.rms_over_noise;
      if (calibration::chi_squared_survival(squares, count) < kStageRare) return false;
    }
  }
  return true;
}

}  // namespace isotach::discovery
