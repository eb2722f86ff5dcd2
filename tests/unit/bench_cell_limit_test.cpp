// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "bench/mpm_problems/cell_limit.hpp"

namespace isotach::bench {
namespace {

constexpr std::array<double, 3> kCells{1.95, 1.3, 1.0};  // mm
constexpr double kLimit = 63.0;

/// Values that leave the limit by slope h^order.
std::array<double, 3> values(double slope, double order) {
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = kLimit + slope * std::pow(kCells[k], order);
  return result;
}

TEST(CellLimit, HoldsTheLimitOfErrorsOfFirstAndSecondOrder) {
  for (const double order : {1.0, 1.5, 2.0}) {
    for (const double slope : {-0.4, 0.4}) {
      const CellLimit limit = cell_limit(kCells, values(slope, order));
      EXPECT_NEAR(limit.value, kLimit, limit.uncertainty + 1e-9) << "order " << order;
    }
  }
}

// Values kLimit + h: the line in h meets h = 0 at kLimit. That in h^2, by hand: means 2.164167 and 1.416667,
// sums of squares 4.264254 and of products 1.414167, so it meets h = 0 at kLimit + 0.698958.
TEST(CellLimit, IsTheMeanOfTheTwoInterceptsAndNoSurerThanTheSeries) {
  const CellLimit limit = cell_limit(kCells, values(1.0, 1.0));
  EXPECT_NEAR(limit.value, kLimit + 0.5 * 0.698958, 1e-6);
  EXPECT_NEAR(limit.uncertainty, 1.95 - 0.5 * 0.698958, 1e-6);
}

TEST(CellLimit, OfEqualValuesIsSure) {
  const CellLimit limit = cell_limit(kCells, values(0.0, 1.0));
  EXPECT_DOUBLE_EQ(limit.value, kLimit);
  EXPECT_NEAR(limit.uncertainty, 0.0, 1e-12);
}

TEST(CellLimit, RefusesFewerThanThreeValues) {
  const std::array<double, 2> two{1.3, 1.0};
  EXPECT_THROW(static_cast<void>(cell_limit(two, two)), std::invalid_argument);
}

TEST(CellLimit, OfScatterIsNoSurerThanTheScatter) {
  const CellLimit limit = cell_limit(kCells, std::array<double, 3>{62.5, 63.5, 62.5});
  EXPECT_GE(limit.uncertainty, 0.5);
}

}  // namespace
}  // namespace isotach::bench
