// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// From the Jacobian at the optimum to standard errors, intervals, correlations and verdicts.
#pragma once

#include "calibration/fit_result.hpp"

namespace isotach::calibration {

/// Whether residuals of neighbouring data are taken as independent.
enum class Correlation {
  independent,  ///< noise of reading
  serial        ///< neighbouring residuals may share an error: standard errors grow by sqrt((1+rho)/(1-rho))
};

/// Gauss-Newton covariance at x. Standard errors grow with sqrt(chi^2/(n - p)) where the misfit exceeds the
/// noise.
[[nodiscard]] tl::expected<Uncertainty, experiments::PredictionFailure> estimate_uncertainty(
    const Problem& problem, const std::vector<double>& x, Correlation correlation);

/// Estimates of all parameters (fixed ones too) at x.
[[nodiscard]] std::vector<ParameterEstimate> estimate_parameters(const Problem& problem,
                                                                 const std::vector<double>& x,
                                                                 const Uncertainty& uncertainty);

/// Correlation matrix of a covariance.
[[nodiscard]] Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance);

/// One summary for each experiment.
[[nodiscard]] std::vector<TestSummary> summarise_tests(const Experiments& experiments,
                                                       const Evaluation& evaluation);

}  // namespace isotach::calibration
