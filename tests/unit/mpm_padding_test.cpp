// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Arrays of points run past the last one. What lies there must have no say in anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpm/slump_run.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::mpm {
namespace {

TEST(Padding, RepeatsTheLastPointUpToWholePacks) {
  Particles q;
  q.count = 11;
  q.for_each_array([](mpm::PointArray& array) { array.assign(64, 1.0); });
  q.for_each_array([](mpm::PointArray& array) { array[10] = 7.0; });
  for (auto& component : q.omega) component.clear();
  q.mass[11] = q.solid_volume[11] = 0.0;
  q.repeat_last(8);
  EXPECT_EQ(q.void_ratio[15], 7.0);
  EXPECT_EQ(q.stress[3][11], 7.0);
  EXPECT_EQ(q.void_ratio[16], 1.0);
  EXPECT_EQ(q.mass[11], 0.0) << "nothing that weighs";
  EXPECT_EQ(q.solid_volume[11], 0.0);
}

// 6 by 22 points: the last pack holds four. The step is what the stiffest of them allows,
// 0.8 h/(c + v) with v up to 1 m/s beside c of 20 m/s or more, and so keeps its length within some percent.
TEST(Padding, DoesNotShortenStepsOfASlump) {
  SlumpSetup setup;
  setup.mud.void_ratio = 3.891;
  setup.mould.diameter = 0.078;
  setup.mould.fill_height = 0.143;
  setup.numerics.cell_size = 0.013;
  setup.numerics.inertia_scaling = 1.0;
  SlumpRun run(tests::seed_mud(), setup);
  ASSERT_EQ(run.particles().count, 132U);
  ASSERT_FALSE(run.step(0.6).has_value());
  const double first = run.last_step();
  double shortest = first;
  while (run.time() < 0.6) {
    ASSERT_FALSE(run.step(0.6).has_value());
    if (run.time() < 0.6) shortest = std::min(shortest, run.last_step());
  }
  EXPECT_GT(shortest, 0.8 * first);
  const Particles& q = run.particles();
  for (std::size_t i = q.count; i < 136; ++i) EXPECT_NEAR(q.void_ratio[i], q.void_ratio[q.count - 1], 1e-9);
}

}  // namespace
}  // namespace isotach::mpm
