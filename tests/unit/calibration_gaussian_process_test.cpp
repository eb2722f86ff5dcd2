// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Kriging: what it reproduces exactly, how it improves with values, and what it says of its own error.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/gaussian_process.hpp"
#include "calibration/latin_hypercube.hpp"

namespace isotach::calibration {
namespace {

double smooth(const Eigen::VectorXd& x) {
  return std::sin(3.0 * x[0]) * std::exp(-x[1]);
}
double quadratic(const Eigen::VectorXd& x) {
  return 2.0 - x[0] + 3.0 * x[0] * x[1] - 4.0 * x[1] * x[1];
}

Eigen::MatrixXd design(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto points = latin_hypercube(n, 2, random);
  Eigen::MatrixXd inputs(static_cast<Eigen::Index>(n), 2);
  for (std::size_t i = 0; i < n; ++i) {
    inputs.row(static_cast<Eigen::Index>(i)) << points[i][0], points[i][1];
  }
  return inputs;
}

template <class F>
Eigen::VectorXd values(const Eigen::MatrixXd& inputs, F&& f, double noise = 0.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::VectorXd y(inputs.rows());
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = f(inputs.row(i).transpose()) + noise * normal(random);
  return y;
}

template <class F>
double largest_error(const GaussianProcess& process, F&& f) {
  double largest = 0.0;
  for (double a = 0.05; a < 1.0; a += 0.09) {
    for (double b = 0.05; b < 1.0; b += 0.09) {
      const Eigen::Vector2d x(a, b);
      largest = std::max(largest, std::abs(process.mean(x) - f(x)));
    }
  }
  return largest;
}

TEST(GaussianProcess, GoesThroughValuesWithoutNoise) {
  const Eigen::MatrixXd inputs = design(20, 1);
  const Eigen::VectorXd y = values(inputs, smooth);
  const GaussianProcess process(inputs, y);
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(process.mean(inputs.row(i).transpose()), y[i], 1e-4);
    EXPECT_LT(process.variance(inputs.row(i).transpose()), 1e-6);
  }
}

TEST(GaussianProcess, AQuadraticIsItsTrend) {
  const Eigen::MatrixXd inputs = design(16, 2);
  EXPECT_LT(largest_error(GaussianProcess(inputs, values(inputs, quadratic)), quadratic), 1e-5);
}

TEST(GaussianProcess, MoreValuesMakeItBetter) {
  double before = HUGE_VAL;
  for (const std::size_t n : {12U, 24U, 48U}) {
    const Eigen::MatrixXd inputs = design(n, 3);
    const double error = largest_error(GaussianProcess(inputs, values(inputs, smooth)), smooth);
    EXPECT_LT(error, 0.5 * before) << n;
    before = error;
  }
  EXPECT_LT(before, 2e-3);
}

TEST(GaussianProcess, FindsTheNoise) {
  constexpr double kNoise = 0.02;
  const Eigen::MatrixXd inputs = design(120, 4);
  const GaussianProcess process(inputs, values(inputs, smooth, kNoise));
  EXPECT_NEAR(process.noise(), kNoise, 0.2 * kNoise);  // 120 values: 7 % is one standard error
  EXPECT_LT(largest_error(process, smooth), 2.5 * kNoise);
}

// Left out means left out: the same prediction as of a process made without the value, at the same lengths.
TEST(GaussianProcess, LeftOutValuesArePredictedByTheOthers) {
  const Eigen::MatrixXd inputs = design(60, 5);
  const Eigen::VectorXd y = values(inputs, smooth, 0.01);
  const GaussianProcess all(inputs, y);
  Eigen::MatrixXd fewer(59, 2);
  Eigen::VectorXd fewer_values(59);
  constexpr Eigen::Index kOut = 17;
  for (Eigen::Index i = 0, k = 0; i < 60; ++i) {
    if (i == kOut) continue;
    fewer.row(k) = inputs.row(i);
    fewer_values[k++] = y[i];
  }
  const GaussianProcess without(fewer, fewer_values);  // finds lengths of its own, hardly others
  const double error = y[kOut] - without.mean(inputs.row(kOut).transpose());
  EXPECT_NEAR(all.left_out()[kOut], error, 0.1 * std::abs(error) + 5e-4);
}

// 95 % intervals of the function hold it where they should.
TEST(GaussianProcess, VarianceTellsTheError) {
  const Eigen::MatrixXd inputs = design(30, 6);
  const GaussianProcess process(inputs, values(inputs, smooth, 0.01));
  int inside = 0;
  int count = 0;
  for (double a = 0.02; a < 1.0; a += 0.04) {
    for (double b = 0.02; b < 1.0; b += 0.04) {
      const Eigen::Vector2d x(a, b);
      ++count;
      inside += std::abs(process.mean(x) - smooth(x)) < 1.96 * std::sqrt(process.variance(x)) ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 0.75 * count);
}

TEST(GaussianProcess, TooFewValuesAreRefused) {
  EXPECT_THROW(GaussianProcess(design(4, 8), Eigen::VectorXd::Zero(4)), std::invalid_argument);
}

}  // namespace
}  // namespace isotach::calibration
