// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How well slump tests determine what was fitted to them: map, profiles and other searches, on a surrogate.
#pragma once

#include <memory>
#include <tl/expected.hpp>
#include <vector>

#include "calibration/profile.hpp"
#include "calibration/slump_surrogate.hpp"
#include "calibration/uncertainty.hpp"

namespace isotach::calibration {

/// Twice the cost above its least, over two coordinates, the others at their best.
struct MisfitMap {
  std::size_t first = 0;   ///< coordinate along x
  std::size_t second = 0;  ///< coordinate along y
  std::vector<double> x;
  std::vector<double> y;
  Eigen::MatrixXd rise;  ///< a row for each x, a column for each y
};

struct SlumpMap {
  std::shared_ptr<const SlumpSurrogate> surrogate;
  std::size_t points = 0;                     ///< simulated, all tests at each
  std::size_t failed = 0;                     ///< of them without a result
  int enlarged = 0;                           ///< how often the box had to grow to hold what it should show
  std::vector<std::vector<double>> training;  ///< the points
  std::vector<double> best;                   ///< coordinates of the surrogate's least misfit
  double cost = 0.0;                          ///< there, by the surrogate
  std::vector<Profile> profiles;              ///< by coordinate
  std::vector<MisfitMap> maps;                ///< of the first two coordinates; none of a single one
  std::vector<OptimiserResult> routes;        ///< independent searches on the surrogate, each from `answer`
};

struct SlumpMapOptions {
  int threads = 1;
  unsigned seed = 1;
  OptimiserControl control;  ///< its callback hears of simulations done
};

/// Simulates the problem's tests at points about `answer`, several standard errors wide, learns a surrogate
/// from them, and widens it until it holds the 95 % intervals or reaches the bounds.
[[nodiscard]] tl::expected<SlumpMap, FitFailure> map_slump(const Problem& problem,
                                                           const std::vector<double>& answer,
                                                           const Uncertainty& uncertainty,
                                                           const SlumpMapOptions& options);

}  // namespace isotach::calibration
