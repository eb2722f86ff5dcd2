// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The same fit from many starts: how many different answers there are.
#pragma once

#include <vector>

#include "calibration/clusters.hpp"
#include "calibration/optimisers.hpp"

namespace isotach::calibration {

struct MultiStart {
  int starts = 0;
  int failed = 0;                 ///< starts from which nothing could be predicted, however near the first
  std::vector<Cluster> clusters;  ///< of the answers, the best first
  std::vector<std::vector<double>> from;  ///< the starts
  bool moved_the_answer = false;  ///< one of them ended better than the first, and its answer was taken
};

struct MultiStartOptions {
  int starts = 12;  ///< besides the first
  unsigned seed = 1;
  int threads = 1;
  /// Half widths of the box of starts about the first one: of logarithms, and of other coordinates as a share
  /// of their range.
  double spread = 0.9;
};

/// Fits from a Latin hypercube of starts around `first`, within the bounds; answers are told apart by half a
/// standard error, `information` being J'J at the best known answer.
[[nodiscard]] MultiStart multi_start(const Problem& problem, const std::vector<double>& first,
                                     const Eigen::MatrixXd& information, const MultiStartOptions& options,
                                     const OptimiserControl& control);

}  // namespace isotach::calibration
