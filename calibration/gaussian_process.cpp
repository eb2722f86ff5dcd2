// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/gaussian_process.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

namespace isotach::calibration {

namespace {

constexpr double kLeastLength = 0.05;
constexpr double kMostLength = 50.0;
constexpr double kLeastNoise = 1e-9;  // of the process's variance
constexpr double kMostNoise = 1.0;
constexpr double kStartLengths[] = {0.3, 1.0, 4.0};
constexpr double kStartNoise = 1e-4;

double kernel(double distance_squared) {
  return std::exp(-0.5 * distance_squared);
}

Eigen::VectorXd trend_at(const Eigen::VectorXd& input, bool quadratic) {
  const Eigen::Index d = input.size();
  Eigen::VectorXd terms(1 + d + (quadratic ? d * (d + 1) / 2 : 0));
  terms[0] = 1.0;
  terms.segment(1, d) = input;
  Eigen::Index next = 1 + d;
  for (Eigen::Index i = 0; quadratic && i < d; ++i) {
    for (Eigen::Index j = i; j < d; ++j) terms[next++] = input[i] * input[j];
  }
  return terms;
}

/// What the likelihood needs of one set of lengths and noise.
struct Model {
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::MatrixXd solved_trend;
  Eigen::LLT<Eigen::MatrixXd> trend_factor;
  Eigen::VectorXd coefficients;
  Eigen::VectorXd weights;
  double variance = 0.0;
  double deviance = HUGE_VAL;  ///< -2 ln of the restricted likelihood, but for a constant

  /// `logs`: the lengths', and that of the noise's share of the variance.
  Model(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& terms, const Eigen::VectorXd& values,
        const std::vector<double>& logs) {
    const Eigen::Index n = inputs.rows();
    const Eigen::Index d = inputs.cols();
    Eigen::MatrixXd scaled = inputs;
    for (Eigen::Index k = 0; k < d; ++k) scaled.col(k) /= std::exp(logs[static_cast<std::size_t>(k)]);
    Eigen::MatrixXd correlation(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      correlation(i, i) = 1.0 + std::exp(logs.back());
      for (Eigen::Index j = 0; j < i; ++j) {
        correlation(i, j) = correlation(j, i) = kernel((scaled.row(i) - scaled.row(j)).squaredNorm());
      }
    }
    factor.compute(correlation);
    if (factor.info() != Eigen::Success) return;
    solved_trend = factor.solve(terms);
    trend_factor.compute(terms.transpose() * solved_trend);
    if (trend_factor.info() != Eigen::Success) return;
    coefficients = trend_factor.solve(solved_trend.transpose() * values);
    const Eigen::VectorXd rest = values - terms * coefficients;
    weights = factor.solve(rest);
    const auto degrees = static_cast<double>(n - terms.cols());
    variance = std::max(rest.dot(weights), 1e-300) / degrees;
    deviance = degrees * std::log(variance) + log_determinant(factor) + log_determinant(trend_factor);
  }

  static double log_determinant(const Eigen::LLT<Eigen::MatrixXd>& llt) {
    const Eigen::MatrixXd lower = llt.matrixL();
    return 2.0 * lower.diagonal().array().log().sum();
  }
};

struct Likelihood {
  const Eigen::MatrixXd& inputs;
  const Eigen::MatrixXd& terms;
  const Eigen::VectorXd& values;
};

double deviance(const std::vector<double>& logs, std::vector<double>&, void* data) {
  const auto& of = *static_cast<const Likelihood*>(data);
  const double value = Model(of.inputs, of.terms, of.values, logs).deviance;
  return std::isfinite(value) ? value : 1e12;
}

/// Logarithms of lengths and noise of the largest likelihood.
std::vector<double> most_likely(Likelihood likelihood) {
  const auto count = static_cast<unsigned>(likelihood.inputs.cols()) + 1;
  std::vector<double> lower(count, std::log(kLeastLength));
  std::vector<double> upper(count, std::log(kMostLength));
  lower.back() = std::log(kLeastNoise);
  upper.back() = std::log(kMostNoise);
  std::vector<double> best;
  double least = HUGE_VAL;
  for (const double length : kStartLengths) {
    nlopt::opt optimiser(nlopt::LN_BOBYQA, count);
    optimiser.set_lower_bounds(lower);
    optimiser.set_upper_bounds(upper);
    optimiser.set_min_objective(deviance, &likelihood);
    optimiser.set_initial_step(0.7);
    optimiser.set_xtol_abs(1e-3);
    optimiser.set_maxeval(400);
    std::vector<double> logs(count, std::log(length));
    logs.back() = std::log(kStartNoise);
    double value = HUGE_VAL;
    try {
      optimiser.optimize(logs, value);
    } catch (const nlopt::roundoff_limited&) {  // as near as it gets
      value = Model(likelihood.inputs, likelihood.terms, likelihood.values, logs).deviance;
    }
    if (value < least) {
      least = value;
      best = logs;
    }
  }
  return best;
}

}  // namespace

GaussianProcess::GaussianProcess(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& values)
    : inputs_(inputs) {
  const Eigen::Index n = inputs.rows();
  const Eigen::Index d = inputs.cols();
  if (n != values.size() || n <= d + 2) throw std::invalid_argument("too few values for a Gaussian process");
  quadratic_ = n >= (d + 1) * (d + 2);
  Eigen::MatrixXd terms(n, trend_at(inputs.row(0), quadratic_).size());
  for (Eigen::Index i = 0; i < n; ++i) terms.row(i) = trend_at(inputs.row(i), quadratic_);
  const std::vector<double> logs = most_likely({inputs, terms, values});
  Model model(inputs, terms, values, logs);
  if (!std::isfinite(model.deviance)) throw std::invalid_argument("inputs of a Gaussian process coincide");
  lengths_ = Eigen::Map<const Eigen::VectorXd>(logs.data(), d).array().exp();
  variance_ = model.variance;
  noise_ = std::sqrt(model.variance * std::exp(logs.back()));
  // e_i = [Q y]_i/Q_ii, Q = K^-1 - K^-1 B (B' K^-1 B)^-1 B' K^-1 (Dubrule 1983)
  Eigen::MatrixXd q = model.factor.solve(Eigen::MatrixXd::Identity(n, n));
  q -= model.solved_trend * model.trend_factor.solve(model.solved_trend.transpose());
  left_out_ = (q * values).array() / q.diagonal().array();
  factor_ = std::move(model.factor);
  solved_trend_ = std::move(model.solved_trend);
  trend_factor_ = std::move(model.trend_factor);
  coefficients_ = std::move(model.coefficients);
  weights_ = std::move(model.weights);
}

Eigen::VectorXd GaussianProcess::trend(const Eigen::VectorXd& input) const {
  return trend_at(input, quadratic_);
}

Eigen::VectorXd GaussianProcess::correlations(const Eigen::VectorXd& input) const {
  Eigen::VectorXd k(inputs_.rows());
  for (Eigen::Index i = 0; i < k.size(); ++i) {
    k[i] = kernel(((inputs_.row(i).transpose() - input).array() / lengths_.array()).matrix().squaredNorm());
  }
  return k;
}

double GaussianProcess::mean(const Eigen::VectorXd& input) const {
  return trend(input).dot(coefficients_) + correlations(input).dot(weights_);
}

double GaussianProcess::variance(const Eigen::VectorXd& input) const {
  const Eigen::VectorXd k = correlations(input);
  const Eigen::VectorXd u = trend(input) - solved_trend_.transpose() * k;
  return std::max(0.0, variance_ * (1.0 - k.dot(factor_.solve(k)) + u.dot(trend_factor_.solve(u))));
}

}  // namespace isotach::calibration
