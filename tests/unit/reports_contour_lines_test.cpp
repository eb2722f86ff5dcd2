// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Lines of equal value of a plane and of a cone, whose places are known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "reports/contour_lines.hpp"

namespace isotach::reports {
namespace {

std::vector<double> axis(int n, double from, double to) {
  std::vector<double> values;
  for (int i = 0; i <= n; ++i) values.push_back(from + (to - from) * i / n);
  return values;
}

template <class F>
Eigen::MatrixXd sampled(const std::vector<double>& x, const std::vector<double>& y, F&& f) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(x.size()), static_cast<Eigen::Index>(y.size()));
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      values(i, j) = f(x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)]);
    }
  }
  return values;
}

/// Length of a line of pieces that NaN parts.
double length(const Series& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.x.size(); ++i) {
    const double piece = std::hypot(line.x[i] - line.x[i - 1], line.y[i] - line.y[i - 1]);
    if (std::isfinite(piece)) sum += piece;
  }
  return sum;
}

TEST(ContourLine, OfAPlaneIsStraightAndExact) {
  const auto x = axis(7, 0.0, 1.0);
  const auto y = axis(5, 0.0, 2.0);
  const Series line = contour_line(x, y, sampled(x, y, [](double a, double b) { return a + b; }), 1.23);
  ASSERT_FALSE(line.x.empty());
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (std::isfinite(line.x[i])) {
      EXPECT_NEAR(line.x[i] + line.y[i], 1.23, 1e-12);
    }
  }
  EXPECT_NEAR(length(line), std::sqrt(2.0), 1e-12);  // from (0, 1.23) to (1, 0.23)
}

TEST(ContourLine, OfAConeIsACircle) {
  const auto x = axis(60, -1.0, 1.0);
  const Eigen::MatrixXd cone = sampled(x, x, [](double a, double b) { return std::hypot(a, b); });
  EXPECT_NEAR(length(contour_line(x, x, cone, 0.7)), 2.0 * std::acos(-1.0) * 0.7, 0.01);
}

TEST(ContourLine, LevelsThatAreNotMetHaveNone) {
  const auto x = axis(4, 0.0, 1.0);
  EXPECT_TRUE(contour_line(x, x, sampled(x, x, [](double a, double b) { return a * b; }), 1.5).x.empty());
}

TEST(ContourLine, StopsWhereValuesAreMissing) {
  const auto x = axis(10, 0.0, 1.0);
  Eigen::MatrixXd plane = sampled(x, x, [](double a, double) { return a; });
  plane(5, 10) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(length(contour_line(x, x, plane, 0.52)), 0.9, 1e-12) << "one cell of ten has a corner missing";
}

}  // namespace
}  // namespace isotach::reports
