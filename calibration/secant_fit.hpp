// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Gauss-Newton with secants for derivatives: few evaluations, where each is a set of simulations.
#pragma once

#include <functional>

#include "calibration/optimisers.hpp"

namespace isotach::calibration {

/// A point of a problem with what is known there.
struct SecantPoint {
  std::vector<double> coordinates;
  Eigen::VectorXd residuals;  ///< weighted, priors below
  Eigen::MatrixXd jacobian;   ///< of them by the coordinates; columns that are zero stay where they are

  [[nodiscard]] double cost() const { return cost_of(residuals); }
};

/// What is made of a problem's residuals before they are squared; empty: nothing.
using ResidualMap = std::function<Eigen::VectorXd(Eigen::VectorXd)>;

struct SecantOptions {
  int max_evaluations = 8;
  double cost_tolerance = 0.5;  ///< a step that promises no more ends the search
  ResidualMap map{};            ///< that SecantPoint::residuals have gone through
};

struct SecantFit {
  SecantPoint at;
  int evaluations = 0;
  bool converged = false;
  bool interrupted = false;
};

/// From `start`, whose Jacobian may be of differences as wide as the search: steps to the least of the linear
/// problem within bounds and kLongestStep, the Jacobian corrected by what each step finds (Broyden 1965);
/// steps that lead up or fail are shortened.
[[nodiscard]] SecantFit minimise_by_secants(const Problem& problem, const SecantPoint& start,
                                            const SecantOptions& options, const OptimiserControl& control);

}  // namespace isotach::calibration
