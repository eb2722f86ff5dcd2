// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What calibration, discovery and reports know of a test: values measured, their noise, and what a model
// predicts.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "effects/catalogue.hpp"
#include "model/parameters.hpp"

namespace isotach::experiments {

/// Why a prediction could not be made.
struct PredictionFailure {
  std::string message;
  bool interrupted = false;  ///< stopped on request, not by the numerics
};

/// Values aligned with the data.
using Values = std::vector<double>;

/// A quantity that a fit may move along with the material: K0 or OCR of one test's start, the state that a
/// mud has in all tests, or a parameter of an effect, which all tests share.
struct LocalQuantity {
  std::string name;  ///< "K0", "OCR", "ring_friction.mu"
  double value;      ///< as the study gives it (SI)
  double lower;      ///< bounds, lower < upper
  double upper;
  bool logarithmic;                 ///< moved as its logarithm
  std::optional<double> std_error;  ///< of the prior around `value`, of the logarithm where that moves
  std::optional<effects::ParameterRef> effect{};  ///< of which it is a parameter
  bool of_all = false;  ///< one value for all tests that have one of that name, as an effect's always is

  [[nodiscard]] bool shared() const { return of_all || effect.has_value(); }
};

/// That of an effect's parameter (SI), bounded as the catalogue has it.
[[nodiscard]] LocalQuantity local_quantity(const effects::ParameterRef& parameter, double value);

/// Predicted values and their derivatives along directions of the inputs.
struct Linearisation {
  Values values;
  Eigen::MatrixXd jacobian;  ///< one row a value, one column a direction
};

/// A series of values with one kind of noise, as they were read.
struct Channel {
  std::string_view quantity;        ///< with its unit in brackets
  std::vector<std::size_t> values;  ///< indices of its values, in order
  std::vector<std::size_t> chains;  ///< positions in `values` at which a series begins anew; the first is 0
  Eigen::VectorXd inverse_stress;   ///< 1/stress (1/Pa), where noise has a floor of stress; else empty
  double stated_level = 0.0;        ///< standard deviation stated, beside floor and known part
  double stated_floor = 0.0;        ///< Pa
  Eigen::VectorXd known_variance;   ///< of each value, not to be estimated: strain's reading times the slope
};

/// A protocol, measured data and their noise. Its inputs are the material's parameters, in SI and the order
/// of ParameterId, and behind them the test's local quantities.
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
  /// The values by kind; every value is in one of them. By default one channel without a floor.
  [[nodiscard]] virtual std::vector<Channel> channels() const;
  /// What a fit moves besides the material, in this test alone.
  [[nodiscard]] virtual std::vector<LocalQuantity> locals() const { return {}; }

  /// What a prediction costs, in a unit of the kind of test: for sharing work out.
  [[nodiscard]] virtual double cost() const { return 0.0; }

  /// `local` has a value for each of locals().
  [[nodiscard]] virtual tl::expected<Values, PredictionFailure> predict(
      const model::Parameters<double>& parameters, std::span<const double> local) const = 0;

  /// Prediction with derivatives; `directions` has a row for each input and a column for each derivative
  /// asked for. By default central differences by those inputs that move, one-sided where the other side
  /// cannot be predicted; exact where the experiment overrides it.
  [[nodiscard]] virtual tl::expected<Linearisation, PredictionFailure> linearise(
      const model::Parameters<double>& parameters, std::span<const double> local,
      const Eigen::MatrixXd& directions) const;

  /// (predicted - measured)/noise of each value.
  [[nodiscard]] Values scaled_residuals(const Values& predicted) const;
  /// locals() as the study gives them.
  [[nodiscard]] std::vector<double> local_values() const;
};

/// Root mean square, 0 for no values.
[[nodiscard]] double root_mean_square(std::span<const double> values);

}  // namespace isotach::experiments
