// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// From the Jacobian at the optimum to standard errors, intervals, correlations and verdicts.
#pragma once

#include "calibration/fit_result.hpp"

namespace isotach::calibration {

/// What is known of the residuals' noise.
enum class Correlation {
  whitened,     ///< the problem's weights make them independent, of unit variance
  independent,  ///< noise of reading as stated; standard errors grow where the misfit exceeds it
  serial        ///< so, and neighbours may share an error: a further sqrt((1+rho)/(1-rho))
};

/// Gauss-Newton covariance at x, by ceres::Covariance with singular values; directions that no datum sees are
/// left out of it and returned apart. Standard errors grow with sqrt(chi^2/(n - p)) where the misfit exceeds
/// the noise, unless the residuals are whitened.
[[nodiscard]] tl::expected<Uncertainty, experiments::PredictionFailure> estimate_uncertainty(
    const Problem& problem, const std::vector<double>& x, Correlation correlation);

/// Estimates of all parameters (fixed ones too) at x.
[[nodiscard]] std::vector<ParameterEstimate> estimate_parameters(const Problem& problem,
                                                                 const std::vector<double>& x,
                                                                 const Uncertainty& uncertainty);
/// Estimates of the coordinates that belong to tests.
[[nodiscard]] std::vector<LocalEstimate> estimate_locals(const Problem& problem, const std::vector<double>& x,
                                                         const Uncertainty& uncertainty);

/// How well an interval of a quantity determines it. `range` is what it is judged against: its size, or, for
/// one that may be zero, 40 % of the range it can have.
[[nodiscard]] Verdict judge(double half_width, double range, bool at_bound);
/// The range that a material parameter is judged against.
[[nodiscard]] double range_of(model::ParameterId id, const model::Parameters<double>& parameters);

/// Correlation matrix of a covariance.
[[nodiscard]] Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance);

/// One summary for each experiment.
[[nodiscard]] std::vector<TestSummary> summarise_tests(const Experiments& experiments,
                                                       const Evaluation& evaluation);

}  // namespace isotach::calibration
