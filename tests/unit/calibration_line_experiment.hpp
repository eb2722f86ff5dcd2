// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An experiment with a known answer: a straight line in the coordinates of a fit.
#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "calibration/problem.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::tests {

/// Values y(t) = sum_k a_k(t) ln(parameter k) for t = -3 .. 3: linear in the fit's coordinates, so that
/// estimates and covariance have closed forms.
class LineExperiment final : public experiments::Experiment {
 public:
  /// A parameter and its coefficient a_k(t).
  struct Term {
    model::ParameterId id;
    std::function<double(double)> coefficient;
  };
  /// Says why a prediction cannot be made, if it cannot.
  using Refusal =
      std::function<std::optional<experiments::PredictionFailure>(const model::Parameters<double>&)>;

  LineExperiment(std::vector<Term> terms, experiments::Values measured, double noise)
      : terms_(std::move(terms)), measured_(std::move(measured)), noise_(measured_.size(), noise) {}

  LineExperiment& refuse(Refusal refusal) {
    refusal_ = std::move(refusal);
    return *this;
  }
  LineExperiment& hold_out() {
    held_out_ = true;
    return *this;
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] bool held_out() const override { return held_out_; }
  [[nodiscard]] const experiments::Values& measured() const override { return measured_; }
  [[nodiscard]] std::string_view quantity() const override { return "value (-)"; }
  [[nodiscard]] const experiments::Values& noise() const override { return noise_; }

  [[nodiscard]] tl::expected<experiments::Values, experiments::PredictionFailure> predict(
      const model::Parameters<double>& parameters, std::span<const double> /*local*/) const override {
    if (refusal_) {
      if (auto failure = refusal_(parameters)) return tl::unexpected(*failure);
    }
    experiments::Values values(measured_.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (const Term& term : terms_)
        values[i] += term.coefficient(abscissa(i)) * std::log(parameters[term.id]);
    }
    return values;
  }

  [[nodiscard]] tl::expected<experiments::Linearisation, experiments::PredictionFailure> linearise(
      const model::Parameters<double>& parameters, std::span<const double> local,
      const Eigen::MatrixXd& directions) const override {
    auto values = predict(parameters, local);
    if (!values) return tl::unexpected(values.error());
    experiments::Linearisation result{std::move(*values), {}};
    result.jacobian = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(measured_.size()), directions.cols());
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      for (const Term& term : terms_) {
        result.jacobian.row(static_cast<Eigen::Index>(i)) +=
            term.coefficient(abscissa(i)) / parameters[term.id] *
            directions.row(static_cast<Eigen::Index>(term.id));
      }
    }
    return result;
  }

  /// t of value i.
  [[nodiscard]] double abscissa(std::size_t i) const {
    return static_cast<double>(i) - 0.5 * static_cast<double>(measured_.size() - 1);
  }

 private:
  std::string name_ = "line";
  std::vector<Term> terms_;
  experiments::Values measured_;
  experiments::Values noise_;
  bool held_out_ = false;
  Refusal refusal_;
};

inline double constant_term(double) {
  return 1.0;
}
inline double linear_term(double t) {
  return t;
}

/// The quadratic polynomial orthogonal to a line on t = -3 .. 3: sum 0, sum of t times it 0, sum of squares
/// 84, sum of products of neighbours 24.
inline constexpr std::array<double, 7> kCurved{5.0, 0.0, -3.0, -4.0, -3.0, 0.0, 5.0};

inline constexpr double kIntercept = 0.3;  // ln e100
inline constexpr double kSlope = -2.0;     // ln lambda
inline constexpr double kNoise = 0.01;

/// A line with ln e100 = 0.3 and ln lambda = -2 plus `misfit` standard deviations of kCurved, which no line
/// can follow: the least-squares answer is exactly (0.3, -2), its cost 42 misfit^2, its covariance noise^2
/// diag(1/7, 1/28).
inline LineExperiment line(double misfit) {
  experiments::Values measured;
  for (std::size_t i = 0; i < kCurved.size(); ++i) {
    const double t = static_cast<double>(i) - 3.0;
    measured.push_back(kIntercept + kSlope * t + misfit * kNoise * kCurved[i]);
  }
  return LineExperiment(
      {{model::ParameterId::e100, constant_term}, {model::ParameterId::lambda, linear_term}},
      std::move(measured), kNoise);
}

/// The problem of fitting `wanted` to `tests`, without a gauge and with default bounds.
inline calibration::Problem problem_of(const std::vector<LineExperiment>& tests,
                                       const std::vector<model::ParameterId>& wanted,
                                       const model::Parameters<double>& start = seed_mud()) {
  calibration::Experiments experiments;
  for (const LineExperiment& test : tests) experiments.push_back(std::make_shared<LineExperiment>(test));
  return calibration::Problem(experiments, calibration::Parametrisation(start, wanted, {}, {}), 1);
}

}  // namespace isotach::tests
