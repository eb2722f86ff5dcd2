// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Packs of doubles compute what doubles do.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mpm/lanes.hpp"

namespace isotach::mpm {
namespace {

using Values = std::array<double, Lanes::kCount>;

Values stored(const Lanes& lanes) {
  Values values;
  lanes.store(values.data());
  return values;
}

class LanesTest : public testing::Test {
 protected:
  Values random_values(double low, double high) {
    std::uniform_real_distribution<double> distribution(low, high);
    Values values;
    for (double& value : values) value = distribution(random_);
    return values;
  }

 private:
  std::mt19937 random_{7};
};

TEST_F(LanesTest, ArithmeticIsThatOfDoublesLaneByLane) {
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Values x = random_values(-5.0, 5.0);
    const Values y = random_values(0.1, 5.0);
    const Lanes a = Lanes::load(x.data());
    const Lanes b = Lanes::load(y.data());
    Lanes compound = a;
    compound += b;
    compound *= b;
    compound -= a;
    compound /= b;
    for (std::size_t i = 0; i < Lanes::kCount; ++i) {
      EXPECT_EQ((a + b)[i], x[i] + y[i]);
      EXPECT_EQ((a - b)[i], x[i] - y[i]);
      EXPECT_EQ((a * b)[i], x[i] * y[i]);
      EXPECT_EQ((a / b)[i], x[i] / y[i]);
      EXPECT_EQ((-a)[i], -x[i]);
      EXPECT_EQ(abs(a)[i], std::abs(x[i]));
      EXPECT_EQ(min(a, b)[i], std::min(x[i], y[i]));
      EXPECT_EQ(max(a, b)[i], std::max(x[i], y[i]));
      EXPECT_NEAR(compound[i], ((x[i] + y[i]) * y[i] - x[i]) / y[i], 1e-12);
    }
  }
}

TEST_F(LanesTest, ConstantFillsEveryLane) {
  const Values values = stored(Lanes(0.3));
  for (const double value : values) EXPECT_EQ(value, 0.3);
  EXPECT_EQ(value_of(Lanes(0.3)), 0.3);
}

// With AVX-512 Eigen makes its root of an estimate and Newton steps.
TEST_F(LanesTest, RootIsWithinTwoUnitsInTheLastPlace) {
  constexpr double kTwoUlp = 2.0 * std::numeric_limits<double>::epsilon();
  for (int repeat = 0; repeat < 2000; ++repeat) {
    const Values x = random_values(0.0, 1e6);
    const Values root = stored(sqrt(Lanes::load(x.data())));
    for (std::size_t i = 0; i < Lanes::kCount; ++i) {
      EXPECT_NEAR(root[i] / std::sqrt(x[i]), 1.0, kTwoUlp) << "sqrt(" << x[i] << ")";
    }
  }
  EXPECT_EQ(sqrt(Lanes(0.0))[0], 0.0);
  EXPECT_NEAR(sqrt(Lanes(1e-300))[0] * 1e150, 1.0, kTwoUlp);  // the law keeps its roots above this
}

TEST_F(LanesTest, ExpAndLogAreWithinTwoUnitsInTheLastPlace) {
  constexpr double kTwoUlp = 2.0 * std::numeric_limits<double>::epsilon();
  for (int repeat = 0; repeat < 2000; ++repeat) {
    const Values x = random_values(-300.0, 300.0);
    const Values power = stored(exp(Lanes::load(x.data())));
    for (std::size_t i = 0; i < Lanes::kCount; ++i) {
      EXPECT_NEAR(power[i] / std::exp(x[i]), 1.0, kTwoUlp) << "exp(" << x[i] << ")";
    }
    Values y;  // 1e-20 to 1e20
    const Values exponent = random_values(-20.0, 20.0);
    for (std::size_t i = 0; i < Lanes::kCount; ++i) y[i] = std::pow(10.0, exponent[i]);
    const Values logarithm = stored(log(Lanes::load(y.data())));
    for (std::size_t i = 0; i < Lanes::kCount; ++i) {
      const double expected = std::log(y[i]);
      EXPECT_NEAR(logarithm[i], expected, kTwoUlp * std::max(1.0, std::abs(expected)))
          << "log(" << y[i] << ")";
    }
  }
}

TEST_F(LanesTest, SineIsThatOfTheStandardLibrary) {
  const Values x = random_values(-3.0, 3.0);
  const Values sine = stored(sin(Lanes::load(x.data())));
  for (std::size_t i = 0; i < Lanes::kCount; ++i) EXPECT_EQ(sine[i], std::sin(x[i]));
}

}  // namespace
}  // namespace isotach::mpm
