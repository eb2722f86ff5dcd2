// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a fit returns: parameters with their uncertainty, how each test is met, and how the answer was
// reached.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calibration/optimisers.hpp"

namespace isotach::calibration {

/// How well the data determine a parameter.
enum class Verdict { identified, weak, undetermined, fixed, gauge };

[[nodiscard]] std::string_view name_of(Verdict verdict);

/// A parameter after the fit. SI; numbers that do not exist are NaN.
struct ParameterEstimate {
  model::ParameterId id{};
  double value = 0.0;
  double std_error = 0.0;
  double ci95_lower = 0.0;
  double ci95_upper = 0.0;
  Verdict verdict = Verdict::fixed;
  std::string words{};  ///< why that verdict, in a sentence without its end; may be empty
};

/// A quantity of one test's start, or a parameter of an effect, that the fit moved. SI.
struct LocalEstimate {
  std::string name;  ///< "crs-1: K0", "ring_friction.mu", "e0"
  double value = 0.0;
  double std_error = 0.0;
  double ci95_lower = 0.0;
  double ci95_upper = 0.0;
  Verdict verdict = Verdict::fixed;
  std::string words{};
  std::optional<effects::ParameterRef> effect{};  ///< nothing: of tests' start
  bool of_all = false;                            ///< one value for all tests, as an effect's always is

  [[nodiscard]] bool shared() const { return of_all || effect.has_value(); }
};

/// How a test is met.
struct TestSummary {
  std::string name;
  bool held_out = false;
  std::size_t values = 0;
  double rms = 0.0;             ///< of predicted - measured, in the experiment's quantity
  double rms_over_noise = 0.0;  ///< 1 = as good as the noise allows
};

/// Uncertainty of the coordinates from the Jacobian at the optimum.
struct Uncertainty {
  Eigen::MatrixXd covariance;  ///< of the coordinates; along null directions taken as infinite
  double inflation =
      1.0;  ///< factor on standard errors for misfit beyond the noise and for correlated residuals
  double autocorrelation = 0.0;  ///< lag-1, of residuals within tests
  /// Degrees of freedom of the noise's estimate: intervals are Student's.
  double degrees = std::numeric_limits<double>::infinity();
  /// Directions in coordinate space that the data do not see, unit norm.
  std::vector<Eigen::VectorXd> null_directions;

  /// Half width of the 95 % interval in standard errors.
  [[nodiscard]] double quantile() const;
  /// Whether the coordinate takes part in a null direction.
  [[nodiscard]] bool in_null_direction(std::size_t coordinate) const;
};

struct FitResult {
  std::optional<model::Parameters<double>> parameters;
  std::vector<ParameterEstimate> estimates;    ///< all parameters, in the order of ParameterId
  std::vector<LocalEstimate> local_estimates;  ///< of effects and of tests' starts, as far as they moved
  Eigen::MatrixXd correlation;                 ///< of the coordinates
  Uncertainty uncertainty;
  std::vector<TestSummary> tests;        ///< all, held-out ones included
  OptimiserResult main;                  ///< the route whose answer is reported
  std::optional<OptimiserResult> check;  ///< the independent route
  double disagreement = 0.0;  ///< largest difference of the two routes' coordinates in standard errors
  GaugeChoice gauge;
  bool gauged = false;
  std::vector<model::ParameterId> free;  ///< the first of the coordinates
  std::vector<Coordinate> coordinates;   ///< all
  bool adequate = false;  ///< every fitted test is met to within kAdequate times its noise, stage by stage
  std::vector<std::string> warnings;
};

/// rms over noise up to which a test counts as met.
inline constexpr double kAdequate = 1.3;

/// Why a fit could not be done.
struct FitFailure {
  std::string message;
  bool interrupted = false;
};

}  // namespace isotach::calibration
