// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where a hidden effect shows most in slumps, as the discovery benchmark has it.
#include <gtest/gtest.h>

#include "bench/discovery/outline_part.hpp"
#include "discovery/slump_disagreement.hpp"

namespace isotach::bench {
namespace {

using discovery::Zone;

discovery::SlumpTests tests_of_mud_a() {
  const auto study =
      datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
  discovery::SlumpTests all;
  for (std::size_t i = 0; i < 2; ++i) {
    all.push_back(std::make_shared<experiments::SlumpExperiment>(study.slump_tests[i]));
  }
  return all;
}

// Each zone is made up of several stations: more of a little may be more than one of much.
TEST(OutlinePart, IsThatOfTheOutlinesZoneWithMost) {
  const auto tests = tests_of_mud_a();
  const std::size_t first = tests[0]->stations().size();
  const std::size_t second = tests[1]->stations().size();
  for (const Zone zone : {Zone::toe, Zone::flank, Zone::top}) {
    for (const bool lifting : {true, false}) {
      Eigen::VectorXd left = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(first + second), 0.1);
      left[0] = 1.0;  // the first test's first outline at the toe
      std::size_t outline = 0;
      for (std::size_t k = 0; k < second; ++k) {
        const experiments::OutlineStation& station = tests[1]->stations()[k];
        const bool gone = tests[1]->mould_gone()[station.points.front()];
        if (discovery::zone_of(station) != zone || gone == lifting) continue;
        if (outline == 0) outline = station.outline + 1;
        if (station.outline + 1 == outline) left[static_cast<Eigen::Index>(first + k)] = 2.0;
      }
      ASSERT_GT(outline, 0U) << "mud-a has such a place";
      EXPECT_EQ(plainest_part(tests, left), (OutlinePart{zone, lifting}));
    }
  }
}

TEST(OutlinePart, TheFirstNamedIsOfAFittedTest) {
  EXPECT_FALSE(first_part({}));
  discovery::SlumpDisagreement held{"a", true, Zone::toe, true, 0.0, 1.0, 0.0, 9.0};
  discovery::SlumpDisagreement fitted{"b", false, Zone::top, false, 1.0, 2.0, 0.0, 3.0};
  EXPECT_FALSE(first_part({held}));
  EXPECT_EQ(first_part({held, fitted}), (OutlinePart{Zone::top, false}));
}

}  // namespace
}  // namespace isotach::bench
