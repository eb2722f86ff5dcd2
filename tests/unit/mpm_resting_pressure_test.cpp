// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Pressures of points whose averages are hydrostatic: by sums over the points, and by hand for two rows a
// cell.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "mpm/resting_pressure.hpp"

namespace isotach::mpm {
namespace {

constexpr double kCell = 0.004;          // m
constexpr double kUnitWeight = 13e3;     // N/m3
constexpr double kScale = 13e3 * kCell;  // Pa

std::vector<double> even_rows(std::size_t count, double spacing) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < count; ++i) heights.push_back((static_cast<double>(i) + 0.5) * spacing);
  return heights;
}

/// Bilinear average of the rows at height `z` of a corner; NaN where no row is near.
double average_at(double z, const std::vector<double>& heights, const std::vector<double>& values) {
  double weights = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double weight = std::max(0.0, 1.0 - std::abs(heights[i] - z) / kCell);
    weights += weight;
    sum += weight * values[i];
  }
  return sum / weights;
}

void expect_hydrostatic_averages(const std::vector<double>& heights, double surface) {
  const auto pressures =
      resting_pressures(heights, kCell, [&](double z) { return kUnitWeight * (surface - z); });
  ASSERT_EQ(pressures.size(), heights.size());
  for (int corner = 0; corner * kCell < heights.back() + kCell; ++corner) {
    const double z = corner * kCell;
    EXPECT_NEAR(average_at(z, heights, pressures), kUnitWeight * (surface - z), 1e-9 * kScale) << "at " << z;
  }
}

TEST(RestingPressures, AveragesAreHydrostaticAtEveryCorner) {
  expect_hydrostatic_averages(even_rows(10, 0.5 * kCell), 5.0 * kCell);
  expect_hydrostatic_averages(even_rows(15, kCell / 3.0), 5.0 * kCell);
  // a fill that is no whole number of cells
  expect_hydrostatic_averages(even_rows(11, 0.5 * kCell), 5.5 * kCell);
  expect_hydrostatic_averages(even_rows(21, 0.47 * kCell), 21.0 * 0.47 * kCell);
}

// Two rows a cell, deep: the surface's average of depths h/4 and 3h/4 with weights 3/4 and 1/4 is 3h/8. The
// least change of the top cell's rows, shared with the next cell's, that takes it away and leaves the corner
// below as it is. Without sharing it would be -9/16 and 3/16 of the weight of a cell.
TEST(RestingPressures, OnlyRowsNearSurfaceAndBaseDifferFromHydrostatic) {
  const auto heights = even_rows(40, 0.5 * kCell);
  const double surface = 20.0 * kCell;
  const auto pressures =
      resting_pressures(heights, kCell, [&](double z) { return kUnitWeight * (surface - z); });
  const auto change = [&](std::size_t i) {
    return (pressures[i] - kUnitWeight * (surface - heights[i])) / kScale;
  };
  EXPECT_LT(change(39), -0.4);
  EXPECT_GT(change(39), -9.0 / 16.0);
  EXPECT_NEAR(0.75 * change(39) + 0.25 * change(38), -0.375, 1e-9);
  EXPECT_NEAR(0.25 * (change(39) + change(36)) + 0.75 * (change(38) + change(37)), 0.0, 1e-9);
  for (std::size_t i = 12; i < 28; ++i) EXPECT_NEAR(change(i), 0.0, 1e-3);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(change(i), -change(39 - i), 1e-9);  // base and surface
}

TEST(RestingPressures, OneRowACellIsRefused) {
  EXPECT_THROW(resting_pressures(even_rows(10, kCell), kCell,
                                 [](double z) { return kUnitWeight * (10.0 * kCell - z); }),
               std::invalid_argument);
}

}  // namespace
}  // namespace isotach::mpm
