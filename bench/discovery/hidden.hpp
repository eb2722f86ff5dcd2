// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What is hidden in the readings of a benchmark study, how plainly it shows, and the noise on top.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <optional>
#include <random>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "bench/discovery/outside.hpp"
#include "calibration/problem.hpp"

namespace isotach::bench {

/// Effects of the catalogue, or something outside of it, or nothing.
struct Hidden {
  std::vector<effects::Chosen<double>> effects;
  std::optional<Outside> outside;
};

/// ln(axial stress / 1 Pa) that is read, without noise, at each row of a blank test: by CVODES, other than
/// the integrator of fits.
[[nodiscard]] tl::expected<std::vector<double>, std::string> exact_log_stress(
    const datasets::OedometerTest& test, const model::Parameters<double>& truth, const Hidden& hidden);

/// The noise of ln stress: standard deviation `level`, half of the variance white, half first-order
/// autoregressive.
struct ReadingNoise {
  static constexpr double kCorrelation = 0.8;  ///< from reading to reading, of that half
  static constexpr double kShare = 0.5;        ///< of the variance

  double level;

  [[nodiscard]] Eigen::MatrixXd covariance(Eigen::Index count) const;
  [[nodiscard]] std::vector<double> draw(std::size_t count, std::mt19937_64& random) const;
};
/// Standard deviation of the readings of strain (-), independent.
inline constexpr double kStrainNoise = 1e-5;

/// What a change of the readings leaves once the base's parameters have been fitted to it, linearised at the
/// truth, by the covariance of the noise.
struct Left {
  double norm;                         ///< the signal-to-noise ratio: root of the sum of squares, whitened
  std::vector<Eigen::VectorXd> plain;  ///< of each fitted test: over `level`, not whitened
  Eigen::VectorXd white;
};

/// How plainly a change of the fitted tests' readings shows.
class Visibility {
 public:
  /// Of the tests that are not held out, whose base readings are `base` (ln stress, of all tests); `free` are
  /// the parameters that the study moves. Throws std::runtime_error where the truth cannot be linearised.
  Visibility(const std::vector<datasets::OedometerTest>& tests, const std::vector<std::vector<double>>& base,
             const model::Parameters<double>& truth, const std::vector<model::ParameterId>& free,
             ReadingNoise noise);

  /// Of readings of all tests (ln stress).
  [[nodiscard]] Left left_of(const std::vector<std::vector<double>>& readings) const;
  /// What `change`, of the readings of all tests, leaves once `direction`s may be used beside the base's
  /// parameters: norm only.
  [[nodiscard]] double norm_beside(const Eigen::VectorXd& white_change,
                                   const std::vector<Eigen::VectorXd>& white_directions) const;
  /// A change of the readings of each fitted test, stacked, whitened.
  [[nodiscard]] Eigen::VectorXd white(const std::vector<Eigen::VectorXd>& changes) const;

  [[nodiscard]] const std::vector<std::size_t>& fitted() const { return fitted_; }

 private:
  std::vector<std::size_t> fitted_;         // tests
  std::vector<std::vector<double>> base_;   // of the fitted
  std::vector<Eigen::MatrixXd> roots_;      // lower Cholesky factors of their noise
  std::vector<Eigen::MatrixXd> jacobians_;  // not whitened
  Eigen::MatrixXd white_jacobian_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  double level_;
};

}  // namespace isotach::bench
