// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cells and weights of points: the moments that make transfers exact for linear fields.
#include <gtest/gtest.h>

#include <limits>

#include "mpm/cell_place.hpp"

namespace isotach::mpm {
namespace {

constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
constexpr double kCell = 0.5;  // m: places are exact in binary
constexpr std::size_t kStride = 12;

/// Eight places in a cell, the corner and both sides of its middle among them.
const Octet kPlaces{0.0, 0.125, 0.25, 0.4375, 0.5, 0.625, 0.875, 0.9999};

TEST(CellPlace, FindsTheCellAndThePlaceInIt) {
  const CellPlace place = cell_place((kPlaces + 3.0) * kCell, (kPlaces + 2.0) * kCell, 1.0 / kCell, kStride);
  for (std::size_t k = 0; k < kOctet; ++k) {
    EXPECT_EQ(place.cell[k], 2 * 12 + 3);
    EXPECT_EQ(place.row[k], 2);
    EXPECT_NEAR(place.x[k], kPlaces[k], kRounding);
    EXPECT_NEAR(place.y[k], kPlaces[k], kRounding);
  }
}

TEST(SplineOctets, AreNonNegativeWithSumOneFirstMomentZeroAndSecondAQuarter) {
  const SplineOctets s(kPlaces);
  for (std::size_t k = 0; k < kOctet; ++k) {
    double sum = 0.0;
    double first = 0.0;
    double second = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double w = s.weight[a][k];
      const double offset = static_cast<double>(a) - 0.5 - kPlaces[k];  // nodes at -1/2, 1/2, 3/2 cells
      EXPECT_GE(w, 0.0);
      sum += w;
      first += w * offset;
      second += w * offset * offset;
    }
    EXPECT_NEAR(sum, 1.0, kRounding);
    EXPECT_NEAR(first, 0.0, kRounding);
    EXPECT_NEAR(second, 0.25, kRounding);
  }
}

// A node's weight is the spline 3/4 - x^2 within half a cell and (3/2 - |x|)^2/2 beyond: 3/4 at the node, 1/2
// half a cell away, 1/8 a cell away.
TEST(SplineOctets, TakeTheSplinesValuesAtANodeAndBetweenTwo) {
  const SplineOctets s(kPlaces);
  EXPECT_DOUBLE_EQ(s.weight[0][4], 0.125);
  EXPECT_DOUBLE_EQ(s.weight[1][4], 0.75);
  EXPECT_DOUBLE_EQ(s.weight[2][4], 0.125);
  EXPECT_DOUBLE_EQ(s.weight[0][0], 0.5);
  EXPECT_DOUBLE_EQ(s.weight[1][0], 0.5);
  EXPECT_DOUBLE_EQ(s.weight[2][0], 0.0);
}

TEST(CornerOctets, AreBilinear) {
  const CellPlace place{{}, {}, kPlaces, 0.25 + 0.5 * kPlaces};
  const CornerOctets w(place);
  for (std::size_t k = 0; k < kOctet; ++k) {
    EXPECT_NEAR(w.w00[k] + w.w10[k] + w.w01[k] + w.w11[k], 1.0, kRounding);
    EXPECT_NEAR(w.w10[k] + w.w11[k], place.x[k], kRounding);
    EXPECT_NEAR(w.w01[k] + w.w11[k], place.y[k], kRounding);
    EXPECT_NEAR(w.w11[k], place.x[k] * place.y[k], kRounding);
  }
}

TEST(Octets, TransposeTurnsRowsIntoColumns) {
  Octet rows[kOctet];
  for (std::size_t k = 0; k < kOctet; ++k) {
    for (std::size_t p = 0; p < kOctet; ++p) rows[k][p] = static_cast<double>(10 * k + p);
  }
  transpose(rows);
  for (std::size_t p = 0; p < kOctet; ++p) {
    for (std::size_t k = 0; k < kOctet; ++k) EXPECT_EQ(rows[p][k], static_cast<double>(10 * k + p));
  }
}

}  // namespace
}  // namespace isotach::mpm
