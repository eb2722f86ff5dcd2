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
  Values random_powers(double low, double high) {  // of ten
    Values values = random_values(low, high);
    for (double& value : values) value = std::pow(10.0, value);
    return values;
  }

 private:
  std::mt19937 random_{7};
};

constexpr double kUlp = std::numeric_limits<double>::epsilon();

TEST_F(LanesTest, SumsAndProductsAreThoseOfDoublesLaneByLane) {
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

// With AVX-512, quotients and roots are made of estimates and Newton steps. Sizes from 1e-100 to 1e100.
TEST_F(LanesTest, QuotientsAndRootsAreWithinTwoUnitsInTheLastPlace) {
  for (int repeat = 0; repeat < 5000; ++repeat) {
    const Values x = random_powers(-100.0, 100.0);
    const Values y = random_powers(-100.0, 100.0);
    const Lanes a = Lanes::load(x.data());
    const Values ratio = stored(a / Lanes::load(y.data()));
    const Values inverse_a = stored(inverse(a));
    const Values third = stored(3.0 / a);
    const Values root_a = stored(sqrt(a));
    const Values inverse_root_a = stored(inverse_sqrt(a));
    for (std::size_t i = 0; i < Lanes::kCount; ++i) {
      EXPECT_NEAR(ratio[i] / (x[i] / y[i]), 1.0, 2.0 * kUlp) << x[i] << " / " << y[i];
      EXPECT_NEAR(inverse_a[i] * x[i], 1.0, 2.0 * kUlp) << "1/" << x[i];
      EXPECT_NEAR(third[i] * x[i] / 3.0, 1.0, 2.0 * kUlp) << "3/" << x[i];
      EXPECT_NEAR(root_a[i] / std::sqrt(x[i]), 1.0, 2.0 * kUlp) << "sqrt(" << x[i] << ")";
      EXPECT_NEAR(inverse_root_a[i] * std::sqrt(x[i]), 1.0, 2.0 * kUlp) << "1/sqrt(" << x[i] << ")";
    }
  }
}

TEST_F(LanesTest, LimitsAreThoseOfDoubles) {
  EXPECT_EQ(sqrt(Lanes(0.0))[0], 0.0);
  EXPECT_NEAR(sqrt(Lanes(1e-300))[0] * 1e150, 1.0, 2.0 * kUlp);  // the law keeps its roots above this
  EXPECT_EQ(sqrt(Lanes(HUGE_VAL))[0], HUGE_VAL);
  EXPECT_TRUE(std::isnan(sqrt(Lanes(-1.0))[0]));
  EXPECT_EQ(inverse(Lanes(0.0))[0], HUGE_VAL);
  EXPECT_EQ(inverse(Lanes(HUGE_VAL))[0], 0.0);
  EXPECT_EQ(inverse_sqrt(Lanes(0.0))[0], HUGE_VAL);
  EXPECT_EQ((Lanes(2.0) / Lanes(0.0))[0], HUGE_VAL);
  EXPECT_EQ((Lanes(2.0) / Lanes(HUGE_VAL))[0], 0.0);
  EXPECT_TRUE(std::isnan((Lanes(0.0) / Lanes(0.0))[0]));
  EXPECT_EQ(log(Lanes(0.0))[0], -HUGE_VAL);
  EXPECT_EQ(log(Lanes(HUGE_VAL))[0], HUGE_VAL);
  EXPECT_EQ(log(Lanes(1.0))[0], 0.0);
  EXPECT_TRUE(std::isnan(log(Lanes(-1.0))[0]));
  EXPECT_EQ(exp(Lanes(0.0))[0], 1.0);
  EXPECT_EQ(exp(Lanes(1e6))[0], HUGE_VAL);
  EXPECT_LT(exp(Lanes(-1e6))[0], std::numeric_limits<double>::min());
  for (const Lanes& of_nan : {sqrt(Lanes(NAN)), exp(Lanes(NAN)), log(Lanes(NAN)), inverse(Lanes(NAN))}) {
    EXPECT_TRUE(std::isnan(of_nan[0]));
  }
}

TEST_F(LanesTest, ExpAndLogAreWithinTwoUnitsInTheLastPlace) {
  for (int repeat = 0; repeat < 5000; ++repeat) {
    const Values x = random_values(-300.0, 300.0);
    const Values power = stored(exp(Lanes::load(x.data())));
    const Values y = repeat % 2 == 0 ? random_powers(-20.0, 20.0) : random_values(0.5, 2.0);
    const Values logarithm = stored(log(Lanes::load(y.data())));
    for (std::size_t i = 0; i < Lanes::kCount; ++i) {
      EXPECT_NEAR(power[i] / std::exp(x[i]), 1.0, 2.0 * kUlp) << "exp(" << x[i] << ")";
      const double expected = std::log(y[i]);
      EXPECT_NEAR(logarithm[i], expected, 2.0 * kUlp * std::max(1.0, std::abs(expected)))
          << "log(" << y[i] << ")";
    }
  }
}

TEST_F(LanesTest, ChoiceBetweenLanesCountsWhatIsNotANumberAsLarger) {
  Values x;
  x.fill(0.5);
  x[1] = 2.0;
  x[2] = NAN;
  x[Lanes::kCount - 1] = 1.0;
  const Values chosen = stored(where_le(Lanes::load(x.data()), Lanes(1.0), Lanes(3.0), Lanes(-4.0)));
  for (std::size_t i = 0; i < Lanes::kCount; ++i) EXPECT_EQ(chosen[i], i == 1 || i == 2 ? -4.0 : 3.0);
}

TEST_F(LanesTest, LargestIsThatOfAllLanes) {
  for (std::size_t at = 0; at < Lanes::kCount; ++at) {
    Values x = random_values(-2.0, -1.0);
    x[at] = -0.5;
    EXPECT_EQ(largest(Lanes::load(x.data())), -0.5);
  }
}

}  // namespace
}  // namespace isotach::mpm
