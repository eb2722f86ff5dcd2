// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What calibration, discovery and reports know of a test: values measured, their noise, and what a model
// predicts.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "model/parameters.hpp"

namespace isotach::experiments {

/// Why a prediction could not be made.
struct PredictionFailure {
  std::string message;
  bool interrupted = false;  ///< stopped on request, not by the numerics
};

/// Values aligned with the data.
using Values = std::vector<double>;

/// Predicted values and their derivatives with respect to parameters (SI).
struct Linearisation {
  Values values;
  Eigen::MatrixXd jacobian;  ///< one row a value, one column a parameter asked for
};

/// A protocol, measured data and their noise.
class Experiment {
 public:
  virtual ~Experiment() = default;

  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Predicted but not fitted.
  [[nodiscard]] virtual bool held_out() const = 0;
  /// What is measured, in the quantity that the fit compares, and that quantity's name and unit.
  [[nodiscard]] virtual const Values& measured() const = 0;
  [[nodiscard]] virtual std::string_view quantity() const = 0;
  /// Standard deviation of each measured value, > 0.
  [[nodiscard]] virtual const Values& noise() const = 0;

  [[nodiscard]] virtual tl::expected<Values, PredictionFailure> predict(
      const model::Parameters<double>& parameters) const = 0;

  /// Prediction with derivatives. By default central differences; exact where the experiment overrides it.
  [[nodiscard]] virtual tl::expected<Linearisation, PredictionFailure> linearise(
      const model::Parameters<double>& parameters, std::span<const model::ParameterId> with_respect_to) const;

  /// (predicted - measured)/noise of each value.
  [[nodiscard]] Values scaled_residuals(const Values& predicted) const;
};

/// Root mean square, 0 for no values.
[[nodiscard]] double root_mean_square(std::span<const double> values);

}  // namespace isotach::experiments
