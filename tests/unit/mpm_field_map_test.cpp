// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Maps of a body's fields: averages that can be followed by hand, what stays empty, and the frames of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mpm/archive.hpp"
#include "mpm/field_map.hpp"
#include "mpm/slump.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::mpm {
namespace {

constexpr double kCell = 0.004;  // m

/// A point whose square has the area of a quarter cell.
void add_quarter(FieldSums& sums, double r, double z, double value) {
  sums.add(r, z, r * 0.25 * kCell * kCell, {value, 2.0 * value, 3.0 * value});
}

// Four quarters of the cell at the axis: those at h/4 weigh 1, those at 3h/4 weigh 3.
TEST(FieldSums, AveragesAreWeightedByVolume) {
  FieldSums sums(kCell, 2.0 * kCell, kCell);
  const double near = 0.25 * kCell;
  const double far = 0.75 * kCell;
  add_quarter(sums, near, near, 1.0);
  add_quarter(sums, far, near, 2.0);
  add_quarter(sums, near, far, 3.0);
  add_quarter(sums, far, far, 4.0);
  const FieldMap map = sums.map();
  ASSERT_EQ(map.columns, 2U);
  ASSERT_EQ(map.rows, 1U);
  EXPECT_DOUBLE_EQ(map.cell_size, kCell);
  constexpr float kMean = (1.0F + 3.0F + 3.0F * 2.0F + 3.0F * 4.0F) / 8.0F;  // 2.75
  EXPECT_FLOAT_EQ(map.strain_rate_norm[0], kMean);
  EXPECT_FLOAT_EQ(map.overconsolidation_ratio[0], 2.0F * kMean);
  EXPECT_FLOAT_EQ(map.pore_pressure[0], 3.0F * kMean);
  EXPECT_TRUE(std::isnan(map.strain_rate_norm[1])) << "no point is there";
}

TEST(FieldSums, CellsFilledByLessThanHalfAreEmpty) {
  FieldSums sums(kCell, 2.0 * kCell, kCell);
  add_quarter(sums, 0.25 * kCell, 0.25 * kCell, 1.0);
  for (const double z : {0.25, 0.75}) add_quarter(sums, 1.25 * kCell, z * kCell, 1.0);
  add_quarter(sums, 1.75 * kCell, 0.25 * kCell, 1.0);
  const FieldMap map = sums.map();
  for (const auto* field : {&map.strain_rate_norm, &map.overconsolidation_ratio, &map.pore_pressure}) {
    EXPECT_TRUE(std::isnan((*field)[0])) << "a quarter";
    EXPECT_FALSE(std::isnan((*field)[1])) << "three quarters";
  }
}

// A square that lies on four cells: a quarter of its height on the lower ones, half of its width on each.
TEST(FieldSums, APointIsSharedOutOverTheCellsItLiesOn) {
  FieldSums sums(kCell, 2.0 * kCell, 2.0 * kCell);
  const double volume = kCell * 0.25 * kCell * kCell;
  sums.add(kCell, kCell * (1.0 + 0.125), volume, {1.0, 1.0, 1.0});
  for (const std::size_t column : {0U, 1U}) {
    EXPECT_NEAR(sums.volume(column, 0) / volume, 0.125, 1e-12);
    EXPECT_NEAR(sums.volume(column, 1) / volume, 0.375, 1e-12);
  }
}

TEST(FieldSums, KeepVolumeWhereverPointsLie) {
  std::mt19937 random(7);
  const double width = 10.0 * kCell;
  std::uniform_real_distribution<double> place(1e-6, width);
  std::uniform_real_distribution<double> area(0.0, 2.0 * kCell * kCell);
  FieldSums sums(kCell, width, width);
  double given = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double r = place(random);
    const double volume = r * area(random);
    given += volume;
    sums.add(r, place(random), volume, {0.0, 0.0, 0.0});
  }
  double kept = 0.0;
  for (std::size_t row = 0; row < 10; ++row) {
    for (std::size_t column = 0; column < 10; ++column) kept += sums.volume(column, row);
  }
  EXPECT_NEAR(kept / given, 1.0, 1e-13);
}

// Points at r_c -+ h/4 weigh r: a field linear in r is that of r_c + (h/4)^2/r_c, one linear in z that of
// z_c.
TEST(FieldSums, LinearFieldsAreThoseOfTheCellsCentreOfVolume) {
  constexpr std::size_t kSide = 6;
  FieldSums sums(kCell, kSide * kCell, kSide * kCell);
  for (std::size_t i = 0; i < 2 * kSide; ++i) {
    for (std::size_t j = 0; j < 2 * kSide; ++j) {
      const double r = (static_cast<double>(i) + 0.5) * 0.5 * kCell;
      const double z = (static_cast<double>(j) + 0.5) * 0.5 * kCell;
      sums.add(r, z, r * 0.25 * kCell * kCell, {r, z, 2.0 - 3.0 * r + 5.0 * z});
    }
  }
  const FieldMap map = sums.map();
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      const double middle = (static_cast<double>(column) + 0.5) * kCell;
      const double r = middle + kCell * kCell / 16.0 / middle;
      const double z = (static_cast<double>(row) + 0.5) * kCell;
      const std::size_t cell = row * kSide + column;
      EXPECT_NEAR(map.strain_rate_norm[cell], r, 1e-6 * kCell * kSide);
      EXPECT_NEAR(map.overconsolidation_ratio[cell], z, 1e-6 * kCell * kSide);
      EXPECT_NEAR(map.pore_pressure[cell], 2.0 - 3.0 * r + 5.0 * z, 1e-6);
    }
  }
}

TEST(FieldSums, LargeMapsTakeWholeMultiplesOfTheGridsCell) {
  EXPECT_DOUBLE_EQ(FieldSums(1.0, 200.0, 90.0).cell_size(), 1.0);
  const FieldSums coarse(1.0, 201.0, 90.0);
  EXPECT_DOUBLE_EQ(coarse.cell_size(), 2.0);
  EXPECT_EQ(coarse.map().columns, 101U);
  EXPECT_EQ(coarse.map().rows, 45U);
  EXPECT_DOUBLE_EQ(FieldSums(1.0, 20.0, 999.0).cell_size(), 5.0);
}

TEST(FrameTimes, AreEvenInTheLogarithmOfTimeAndDenseEarly) {
  const std::vector<double> times = frame_times(30.0, 61);
  ASSERT_EQ(times.size(), 61U);
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times.back(), 30.0);
  EXPECT_NEAR(times[30], 0.05 * (std::sqrt(601.0) - 1.0), 1e-12);  // 1.18 s
  for (std::size_t k = 1; k + 1 < times.size(); ++k) {
    EXPECT_GT(times[k + 1] - times[k], times[k] - times[k - 1]);
  }
  EXPECT_TRUE(frame_times(30.0, 0).empty());
  EXPECT_EQ(frame_times(30.0, 1), (std::vector<double>{30.0}));
}

class FramesOfARun : public testing::Test {
 protected:
  FramesOfARun() {
    setup_.numerics.cell_size = 0.0078;
    setup_.mud.void_ratio = 3.891;
    setup_.times = {0.1, 0.3};
  }
  [[nodiscard]] SlumpResult run(std::size_t frames) const {
    RunOptions options;
    options.frames = frames;
    return run_slump(tests::seed_mud(), setup_, options).value();
  }
  SlumpSetup setup_;
};

TEST_F(FramesOfARun, ChangeNothingInIt) {
  SlumpResult with = run(17);
  SlumpResult without = run(0);
  EXPECT_TRUE(without.frames.empty());
  EXPECT_TRUE(without.fields.empty());
  EXPECT_EQ(with.frames.size(), 17U);
  EXPECT_EQ(with.fields.size(), 2U);
  with.frames.clear();
  with.fields.clear();
  Archive a;
  Archive b;
  a(with);
  b(without);
  EXPECT_EQ(a.bytes(), b.bytes());
}

TEST_F(FramesOfARun, ShowTheMudWithinItsOutlineAtTheirTimes) {
  const SlumpResult result = run(9);
  const std::vector<double> times = frame_times(0.3, 9);
  ASSERT_EQ(result.frames.size(), times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Frame& frame = result.frames[k];
    EXPECT_GE(frame.time, times[k]);
    EXPECT_LT(frame.time, times[k] + 0.002) << "more than a step late";
    EXPECT_DOUBLE_EQ(frame.rim, 0.06 * frame.time);
    const FieldMap& map = frame.fields;
    double volume = 0.0;
    for (std::size_t cell = 0; cell < map.columns * map.rows; ++cell) {
      if (std::isnan(map.strain_rate_norm[cell])) continue;
      const double r = (static_cast<double>(cell % map.columns) + 0.5) * map.cell_size;
      volume += 2.0 * std::numbers::pi * r * map.cell_size * map.cell_size;
      EXPECT_GE(map.strain_rate_norm[cell], 0.0F);
      EXPECT_GT(map.overconsolidation_ratio[cell], 0.0F);
    }
    // the cells along the surface are drawn whole or not at all
    EXPECT_NEAR(volume / frame.outline.volume(), 1.0, 0.08) << k;
  }
}

// What is drawn at an output time is what the points of that time say.
TEST_F(FramesOfARun, AtTheOutputTimesAreTheSnapshots) {
  RunOptions options;
  options.frames = 1;
  options.snapshots = true;
  const SlumpResult result = run_slump(tests::seed_mud(), setup_, options).value();
  for (std::size_t k = 0; k < setup_.times.size(); ++k) {
    const FieldMap& map = result.fields[k].fields;
    const Snapshot& snapshot = result.snapshots[k];
    EXPECT_EQ(result.fields[k].time, snapshot.time);
    FieldSums sums(map.cell_size, static_cast<double>(map.columns) * map.cell_size,
                   static_cast<double>(map.rows) * map.cell_size);
    const Particles& q = snapshot.particles;
    for (std::size_t i = 0; i < q.count; ++i) {
      sums.add(
          q.r[i], q.z[i], q.volume(i),
          {snapshot.strain_rate_norm[i], snapshot.overconsolidation_ratio[i], snapshot.pore_pressure[i]});
    }
    const FieldMap expected = sums.map();
    ASSERT_EQ(expected.pore_pressure.size(), map.pore_pressure.size());
    for (std::size_t cell = 0; cell < map.pore_pressure.size(); ++cell) {
      if (std::isnan(expected.pore_pressure[cell])) {
        EXPECT_TRUE(std::isnan(map.pore_pressure[cell]));
      } else {
        EXPECT_EQ(map.pore_pressure[cell], expected.pore_pressure[cell]);
        EXPECT_EQ(map.overconsolidation_ratio[cell], expected.overconsolidation_ratio[cell]);
      }
    }
  }
}

}  // namespace
}  // namespace isotach::mpm
