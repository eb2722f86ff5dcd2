// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// White noise as seen along given directions: for parametric bootstraps.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>

#include "discovery/limits.hpp"

namespace isotach::discovery {

/// Calls f(z) for kReplicates draws of white noise, z its components along `directions`, unit vectors in
/// columns, which may be nearly dependent.
template <class F>
void for_noise_along(const Eigen::MatrixXd& directions, unsigned seed, F&& f) {
  // a root of their correlation by eigenvalues
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(directions.transpose() * directions);
  const Eigen::MatrixXd root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::VectorXd noise(directions.cols());
  for (int b = 0; b < kReplicates; ++b) {
    for (double& value : noise) value = normal(random);
    f(Eigen::VectorXd(root * noise));
  }
}

/// Probability that noise comes as far, where `as_far` of `replicates` draws did: at least 1/(replicates +
/// 1), which stands for "less than that".
[[nodiscard]] inline double replicated_p(std::ptrdiff_t as_far, std::size_t replicates) {
  return (static_cast<double>(as_far) + 1.0) / (static_cast<double>(replicates) + 1.0);
}

}  // namespace isotach::discovery
