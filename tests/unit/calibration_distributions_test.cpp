// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Quantiles and probabilities against printed tables and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "calibration/distributions.hpp"

namespace isotach::calibration {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Abramowitz & Stegun, Handbook of Mathematical Functions, tables 26.1 and 26.6
TEST(Distributions, NormalAgreesWithTables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963985, 5e-10);
  EXPECT_NEAR(normal_quantile(0.025), -1.959963985, 5e-10);
  EXPECT_NEAR(normal_cdf(1.0), 0.841344746068543, 5e-16);
  EXPECT_EQ(normal_cdf(0.0), 0.5);
  EXPECT_EQ(normal_cdf(kInfinity), 1.0);
  EXPECT_EQ(normal_cdf(-kInfinity), 0.0);
}

// Closed forms: one degree is the Cauchy distribution, two have x = (2p - 1) sqrt(2/(4 p (1 - p))).
TEST(Distributions, StudentTHasItsClosedForms) {
  EXPECT_NEAR(student_t_quantile(0.975, 1.0), std::tan(std::numbers::pi * 0.475), 1e-11);
  EXPECT_NEAR(student_t_quantile(0.975, 2.0), 0.95 * std::sqrt(2.0 / (4.0 * 0.975 * 0.025)), 1e-12);
  EXPECT_NEAR(student_t_quantile(0.975, 10.0), 2.228, 5e-4);  // the table in any textbook
  EXPECT_NEAR(student_t_quantile(0.975, kInfinity), normal_quantile(0.975), 1e-12);
}

// Closed form: two degrees are the exponential distribution of mean 2.
TEST(Distributions, ChiSquaredOfTwoDegreesIsExponential) {
  EXPECT_NEAR(chi_squared_quantile(0.95, 2.0), -2.0 * std::log(0.05), 1e-13);
  EXPECT_NEAR(chi_squared_survival(7.0, 2.0), std::exp(-3.5), 1e-16);
  EXPECT_NEAR(chi_squared_survival(200.0, 2.0), std::exp(-100.0), 1e-12 * std::exp(-100.0));
  EXPECT_EQ(chi_squared_survival(0.0, 5.0), 1.0);
  EXPECT_EQ(chi_squared_quantile(0.0, 5.0), 0.0);
  EXPECT_NEAR(chi_squared_quantile(0.95, 1.0), 3.841, 5e-4);  // the table in any textbook
}

TEST(Distributions, RejectArgumentsOutsideTheirRange) {
  for (const double p : {-0.1, 0.0, 1.0, 1.1, kNaN}) {
    EXPECT_THROW((void)normal_quantile(p), std::domain_error) << p;
    EXPECT_THROW((void)student_t_quantile(p, 5.0), std::domain_error) << p;
  }
  for (const double p : {-0.1, 1.1, kNaN}) {
    EXPECT_THROW((void)chi_squared_quantile(p, 5.0), std::domain_error) << p;
  }
  EXPECT_THROW((void)normal_cdf(kNaN), std::domain_error);
  for (const double degrees : {-1.0, 0.0, kNaN}) {
    EXPECT_THROW((void)student_t_quantile(0.9, degrees), std::domain_error) << degrees;
    EXPECT_THROW((void)chi_squared_quantile(0.9, degrees), std::domain_error) << degrees;
    EXPECT_THROW((void)chi_squared_survival(1.0, degrees), std::domain_error) << degrees;
  }
  for (const double x : {-1.0, kNaN, kInfinity}) {
    EXPECT_THROW((void)chi_squared_survival(x, 3.0), std::domain_error) << x;
  }
}

}  // namespace
}  // namespace isotach::calibration
