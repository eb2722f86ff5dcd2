// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Block bootstrap: the spread of the answer over data made of the fit and its own residuals, drawn in blocks.
#pragma once

#include <vector>

#include "calibration/noise_fit.hpp"
#include "calibration/optimisers.hpp"

namespace isotach::calibration {

struct Bootstrap {
  int samples = 0;
  int failed = 0;
  std::vector<std::size_t> blocks;  ///< mean length of a block, of each channel
  Eigen::VectorXd mean;             ///< of the coordinates
  Eigen::VectorXd std_error;
  Eigen::VectorXd lower;  ///< 2.5 % quantile
  Eigen::VectorXd upper;  ///< 97.5 % quantile
};

struct BootstrapOptions {
  int samples = 200;
  unsigned seed = 1;
  int threads = 1;
};

/// Resamples residuals (in units of their estimated standard deviation) in blocks long enough for their
/// autocorrelation, and fits again with the same weights.
[[nodiscard]] Bootstrap bootstrap(const Problem& problem, const NoiseFit& noise, const std::vector<double>& x,
                                  const BootstrapOptions& options, const OptimiserControl& control);

}  // namespace isotach::calibration
