// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What takes the place of slump simulations where many are asked for: maps, profiles, global searches.
#pragma once

#include <memory>
#include <vector>

#include "calibration/gaussian_process.hpp"
#include "calibration/optimisers.hpp"

namespace isotach::calibration {

/// The part of coordinate space that a surrogate knows.
struct CoordinateBox {
  std::vector<double> lower;
  std::vector<double> upper;

  [[nodiscard]] bool contains(const std::vector<double>& x) const;
};

/// Values of a problem's fitted experiments at some points.
struct TrainingSet {
  std::vector<std::vector<double>> points;  ///< coordinates
  std::vector<Eigen::VectorXd> values;      ///< predictions of all fitted experiments, stacked
  std::size_t failed = 0;                   ///< points that could not be predicted; they are left out
  std::string last_failure;
};

/// Predicts all experiments at a Latin hypercube of `count` points in `box` and appends what comes;
/// simulations run on `threads` threads. `seed` chooses the points. Ends early where `stopped()`.
void add_points(const Problem& problem, const CoordinateBox& box, std::size_t count, unsigned seed,
                int threads, const OptimiserControl& control, TrainingSet& set);

/// Predictions of experiments by Gaussian processes: those of the principal components of their values
/// (Higdon et al. 2008), over the coordinates.
class SlumpSurrogate {
 public:
  /// Learns from the points inside of `box`; std::invalid_argument where they are too few
  /// (least_points()).
  SlumpSurrogate(const Problem& problem, const CoordinateBox& box, const TrainingSet& set);

  /// The least number of points: three times the terms of a linear trend.
  [[nodiscard]] static std::size_t least_points(std::size_t coordinates);

  [[nodiscard]] const CoordinateBox& box() const { return box_; }
  [[nodiscard]] std::size_t points() const { return points_; }
  [[nodiscard]] std::size_t components() const { return processes_.size(); }
  /// Root mean square of what points left out are missed by, in units of the values' noise. The scatter that
  /// simulations have of themselves is in it.
  [[nodiscard]] double error() const { return error_; }
  /// The same as directions: by a column each, the root mean square by which a component is missed, times the
  /// component. Rows as those of values(). Errors of one point are alike over all tests, so they do not
  /// average out as noise does.
  [[nodiscard]] const Eigen::MatrixXd& error_directions() const { return error_directions_; }
  /// Values at coordinates x, which may lie outside of the box, where they are worth less.
  [[nodiscard]] Eigen::VectorXd values(const std::vector<double>& x) const;

 private:
  CoordinateBox box_;
  std::size_t points_ = 0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd components_;  ///< a column each, orthonormal
  std::vector<GaussianProcess> processes_;
  Eigen::MatrixXd error_directions_;
  double error_ = 0.0;
};

/// The problem with its fitted experiments' predictions taken from the surrogate, whose error they share
/// beside what they shared before.
[[nodiscard]] Problem with_surrogate(const Problem& problem, std::shared_ptr<const SlumpSurrogate> surrogate);

}  // namespace isotach::calibration
