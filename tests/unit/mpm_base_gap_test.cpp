// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Compression of mud that has not filled the space on the base.
#include <gtest/gtest.h>

#include "mpm/base_gap.hpp"

namespace isotach::mpm {
namespace {

constexpr double kCell = 0.01;  // m
constexpr std::size_t kColumns = 8;
constexpr std::size_t kRows = 6;

/// Volumes at corners of points, four a cell, that fill 0 < r < `width`, `bottom` < z < `top` (m).
class BaseGap : public testing::TestWithParam<Symmetry> {
 protected:
  void fill(double width, double bottom, double top) {
    constexpr int kPoints = 40;  // a cell and direction
    const double spacing = kCell / kPoints;
    for (double r = 0.5 * spacing; r < width; r += spacing) {
      for (double z = bottom + 0.5 * spacing; z < top; z += spacing) {
        const double volume = spacing * spacing * (GetParam() == Symmetry::axisymmetric ? r : 1.0);
        const auto i = static_cast<std::size_t>(r / kCell);
        const auto j = static_cast<std::size_t>(z / kCell);
        const double x = r / kCell - static_cast<double>(i);
        const double y = z / kCell - static_cast<double>(j);
        for (const std::size_t b : {0U, 1U}) {
          field_.pressures.touch(j + b, i + 2);
          for (const std::size_t a : {0U, 1U}) {
            const double weight = (a == 0 ? 1.0 - x : x) * (b == 0 ? 1.0 - y : y);
            field_.pressures.data()[grid_.index(i + a, j + b)].volume += weight * volume;
          }
        }
      }
    }
  }
  /// The rate of corner i on the base after closing, where it was `rate` before.
  double closed(std::size_t i, double rate) {
    std::fill_n(field_.mean.data(), field_.mean.size(), rate);
    close_gap_above_base(grid_, GetParam(), field_);
    return field_.mean[grid_.index(i, 0)];
  }

  Grid grid_{kCell, kColumns* kCell, kRows* kCell, Sides{}};
  CornerField field_{grid_.stride(), grid_.rows() + 2};
};

TEST_P(BaseGap, FilledSpaceIsCompressedAsItIs) {
  fill(5.0 * kCell, 0.0, 3.0 * kCell);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(closed(i, -2.0), -2.0, 1e-2) << "corner " << i;
}

// Gaps of more than a twentieth of a cell leave more than a tenth of the half cell above the base empty.
TEST_P(BaseGap, CompressionClosesTheGap) {
  fill(5.0 * kCell, 0.055 * kCell, 3.0 * kCell);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(closed(i, -2.0), 0.0) << "corner " << i;
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(closed(i, 2.0), 2.0) << "corner " << i;
}

TEST_P(BaseGap, PartOfAGapTakesPartOfTheCompression) {
  fill(5.0 * kCell, 0.025 * kCell, 3.0 * kCell);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(closed(i, -2.0), -1.0, 0.06) << "corner " << i;
}

// Neither the upright end of the mud nor a layer thinner than a cell is a gap.
TEST_P(BaseGap, FreeSurfaceIsNoGap) {
  fill(4.6 * kCell, 0.0, 3.0 * kCell);
  EXPECT_NEAR(closed(4, -2.0), -2.0, 1e-2);
  EXPECT_NEAR(closed(5, -2.0), -2.0, 1e-2);
  field_.pressures.clear();
  fill(5.0 * kCell, 0.0, 0.4 * kCell);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(closed(i, -2.0), -2.0) << "corner " << i;
}

TEST_P(BaseGap, CornersAboveTheBaseAreLeftAlone) {
  fill(5.0 * kCell, 0.5 * kCell, 3.0 * kCell);
  static_cast<void>(closed(0, -2.0));
  for (std::size_t j = 1; j < kRows; ++j) {
    for (std::size_t i = 0; i < kColumns; ++i) EXPECT_EQ(field_.mean[grid_.index(i, j)], -2.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Symmetries, BaseGap, testing::Values(Symmetry::axisymmetric, Symmetry::plane),
                         [](const auto& test) {
                           return test.param == Symmetry::plane ? "plane" : "axisymmetric";
                         });

}  // namespace
}  // namespace isotach::mpm
