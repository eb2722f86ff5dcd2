// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/uncertainty.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <limits>

namespace isotach::calibration {

namespace {

constexpr double kQuantile95 = 1.959963984540054;  // of the normal distribution, two-sided
constexpr double kNullSingularValue = 1e-9;        // relative to the largest: no data see this direction
constexpr double kIdentified = 0.25;               // half width of the 95 % interval relative to the value
constexpr double kWeak = 1.0;

/// Lag-1 autocorrelation of residuals, within each experiment, about zero.
double autocorrelation(const Eigen::VectorXd& residuals, const Experiments& experiments) {
  double products = 0.0;
  double squares = 0.0;
  Eigen::Index begin = 0;
  for (const auto& experiment : experiments) {
    const auto count = static_cast<Eigen::Index>(experiment->measured().size());
    for (Eigen::Index i = begin; i < begin + count; ++i) {
      squares += residuals[i] * residuals[i];
      if (i > begin) products += residuals[i] * residuals[i - 1];
    }
    begin += count;
  }
  return squares > 0.0 ? products / squares : 0.0;
}

Verdict judge(model::ParameterId id, const ParameterEstimate& estimate, bool at_bound, double range) {
  const double half_width = 0.5 * (estimate.ci95_upper - estimate.ci95_lower);
  // a parameter that may be zero is judged against the range it can have at all
  const double relative =
      model::may_be_zero(id) ? half_width / (0.4 * range) : half_width / std::abs(estimate.value);
  if (!(relative <= kWeak)) return Verdict::undetermined;
  if (relative > kIdentified || at_bound) return Verdict::weak;
  return Verdict::identified;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::identified:
      return "identified";
    case Verdict::weak:
      return "weak";
    case Verdict::undetermined:
      return "undetermined";
    case Verdict::fixed:
      return "fixed";
    case Verdict::gauge:
      return "gauge";
  }
  return "";
}

tl::expected<Uncertainty, experiments::PredictionFailure> estimate_uncertainty(const Problem& problem,
                                                                               const std::vector<double>& x,
                                                                               Correlation correlation) {
  const auto linearised = problem.linearise(x);
  if (!linearised) return tl::unexpected(linearised.error());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(linearised->jacobian,
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto& singular = svd.singularValues();
  const Eigen::Index count = linearised->jacobian.cols();
  Uncertainty result;
  result.covariance = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd direction = svd.matrixV().col(k);
    if (singular[k] <= kNullSingularValue * singular[0]) {
      result.null_directions.push_back(direction);
    } else {
      result.covariance += direction * direction.transpose() / (singular[k] * singular[k]);
    }
  }
  const auto data = static_cast<double>(linearised->residuals.size());
  const double degrees = std::max(1.0, data - static_cast<double>(count));
  const double reduced = linearised->residuals.squaredNorm() / degrees;
  double inflation2 = std::max(1.0, reduced);
  if (correlation == Correlation::serial) {
    result.autocorrelation = std::clamp(autocorrelation(linearised->residuals, problem.fitted()), 0.0, 0.99);
    inflation2 *= (1.0 + result.autocorrelation) / (1.0 - result.autocorrelation);
  }
  result.inflation = std::sqrt(inflation2);
  result.covariance *= inflation2;
  return result;
}

std::vector<ParameterEstimate> estimate_parameters(const Problem& problem, const std::vector<double>& x,
                                                   const Uncertainty& uncertainty) {
  const Parametrisation& parametrisation = problem.parametrisation();
  const auto tangent = parametrisation.tangent(x);
  std::vector<ParameterEstimate> estimates;
  if (!tangent) return estimates;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const auto& parameter : model::kParameterTable) {
    estimates.push_back(
        {parameter.id, tangent->parameters[parameter.id], kNone, kNone, kNone, Verdict::fixed});
  }
  const auto& free = parametrisation.free();
  const double widest_C_1 = 1.0 - tangent->parameters.kappa() / tangent->parameters.lambda();
  for (std::size_t k = 0; k < free.size(); ++k) {
    ParameterEstimate& estimate = estimates[static_cast<std::size_t>(free[k])];
    const auto column = static_cast<Eigen::Index>(k);
    double error = std::sqrt(uncertainty.covariance(column, column));
    for (const Eigen::VectorXd& direction : uncertainty.null_directions) {
      if (std::abs(direction[column]) > 1e-6) error = std::numeric_limits<double>::infinity();
    }
    const bool log = parametrisation.logarithmic(k);
    double lower = std::max(x[k] - kQuantile95 * error, parametrisation.lower()[k]);
    double upper = std::min(x[k] + kQuantile95 * error, parametrisation.upper()[k]);
    constexpr double kAtBound = 1e-6;
    const bool at_bound =
        x[k] - parametrisation.lower()[k] < kAtBound || parametrisation.upper()[k] - x[k] < kAtBound;
    estimate.std_error = log ? estimate.value * error : error;
    estimate.ci95_lower = log ? std::exp(lower) : lower;
    estimate.ci95_upper = log ? std::exp(upper) : upper;
    estimate.verdict =
        std::isfinite(error) ? judge(free[k], estimate, at_bound, widest_C_1) : Verdict::undetermined;
  }
  if (parametrisation.gauged()) {
    // D_r follows from the others: its error by the chain rule
    ParameterEstimate& estimate = estimates[static_cast<std::size_t>(model::ParameterId::D_r)];
    const Eigen::RowVectorXd row =
        tangent->derivative.row(static_cast<Eigen::Index>(model::ParameterId::D_r));
    estimate.std_error = std::sqrt((row * uncertainty.covariance * row.transpose())(0, 0));
    estimate.ci95_lower = estimate.value - kQuantile95 * estimate.std_error;
    estimate.ci95_upper = estimate.value + kQuantile95 * estimate.std_error;
    estimate.verdict = Verdict::gauge;
  }
  return estimates;
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd correlation = covariance;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
      correlation(i, j) /= std::sqrt(covariance(i, i) * covariance(j, j));
    }
  }
  return correlation;
}

std::vector<TestSummary> summarise_tests(const Experiments& experiments, const Evaluation& evaluation) {
  std::vector<TestSummary> tests;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const auto& scaled = evaluation.scaled_residuals[i];
    experiments::Values plain(scaled.size());
    for (std::size_t k = 0; k < scaled.size(); ++k) plain[k] = scaled[k] * experiments[i]->noise()[k];
    tests.push_back({experiments[i]->name(), experiments[i]->held_out(), scaled.size(),
                     experiments::root_mean_square(plain), experiments::root_mean_square(scaled)});
  }
  return tests;
}

}  // namespace isotach::calibration
