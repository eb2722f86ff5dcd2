// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "mpm/point_array.hpp"

using namespace isotach;

// Sizes on both sides of those that get pages of their own, and no multiple of any page.
TEST(PointArrays, AreAlignedToALineWhateverTheirSize) {
  std::vector<mpm::PointArray> kept;
  for (const std::size_t count : {1U, 7U, 64U, 1000U, 262143U, 262144U, 262145U, 1000003U}) {
    kept.emplace_back(count, 1.5);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(kept.back().data()) % 64, 0U) << count;
  }
  for (const mpm::PointArray& array : kept) {
    EXPECT_EQ(std::accumulate(array.begin(), array.end(), 0.0), 1.5 * static_cast<double>(array.size()));
  }
}

TEST(PointArrays, KeepTheirValuesWhenTheyGrowIntoPagesOfTheirOwnAndAreMoved) {
  mpm::PointArray array;
  for (std::size_t i = 0; i < 700000; ++i) array.push_back(static_cast<double>(i));
  mpm::PointArray copy = array;
  const mpm::PointArray moved = std::move(array);
  ASSERT_EQ(moved.size(), 700000U);
  for (std::size_t i = 0; i < moved.size(); ++i) ASSERT_EQ(moved[i], static_cast<double>(i));
  copy.resize(3);
  copy.shrink_to_fit();
  EXPECT_EQ(copy, (mpm::PointArray{0.0, 1.0, 2.0}));
}
