// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How far apart compared slumps are: outlines made by hand.
#include <gtest/gtest.h>

#include "reports/slump_comparison.hpp"
#include "reports/slump_differences.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::reports {
namespace {

/// Height and toe (m) at a time (s).
struct Extent {
  double time;
  double height;
  double toe;
};

/// The seed's mud at e = 3.891, which came out as given.
ComparedSlump slump_of(const std::string& name, const std::vector<Extent>& extents) {
  mpm::SlumpSetup setup;
  setup.mud.void_ratio = 3.891;
  mpm::SlumpResult result;
  result.initial = mpm::initial_state(tests::seed_mud(), setup.mud);
  for (const auto& [time, height, toe] : extents) {
    setup.times.push_back(time);
    result.outlines.push_back({time, {{toe, 0.0}, {0.5 * toe, height}, {0.0, height}}});
  }
  result.history.push_back({});
  return {name, {name + ".toml", tests::seed_mud(), setup, {}, {}}, std::move(result)};
}

class SlumpDifferences : public testing::Test {
 protected:
  const RunInfo run_{.command = "slump", .version = "1.2.3", .input = "middle.toml", .seconds = 1.0};
  const std::vector<ComparedSlump> slumps_{
      slump_of("middle", {{1.0, 0.070, 0.080}, {2.0, 0.060, 0.085}, {30.0, 0.055, 0.086}}),
      slump_of("high", {{1.0, 0.082, 0.070}, {30.0, 0.061, 0.080}}),
      slump_of("low", {{1.0, 0.062, 0.091}, {2.0, 0.058, 0.095}, {30.0, 0.053, 0.0865}})};
};

TEST_F(SlumpDifferences, AreBetweenTheExtremesAtEachTimeThatAllHave) {
  const std::vector<SpreadAt> all = spreads(ended(slumps_));
  ASSERT_EQ(all.size(), 2U) << "at 2 s one has no outline";
  EXPECT_EQ(all[0].time, 1.0);
  EXPECT_NEAR(all[0].height.difference(), 0.020, 1e-12);
  EXPECT_EQ(all[0].height.least_in->name, "low");
  EXPECT_EQ(all[0].height.greatest_in->name, "high");
  EXPECT_NEAR(all[0].toe.difference(), 0.021, 1e-12);
  EXPECT_EQ(all[0].toe.greatest_in->name, "low");
  EXPECT_EQ(all[1].time, 30.0);
  EXPECT_NEAR(all[1].toe.difference(), 0.0065, 1e-12);
}

TEST_F(SlumpDifferences, StandInTheReport) {
  const std::string html = slump_comparison_report(run_, slumps_).html();
  for (const char* part :
       {"What differs between these runs",
        "Heights differ most at 1 s, by 20.0 mm (low, high), at 30 s by 8.00 mm (low, high).",
        "Toes differ most at 1 s, by 21.0 mm (high, low), at 30 s by 6.50 mm (high, low).",
        ">82.0 (high)</td>"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
}

TEST_F(SlumpDifferences, OfOneTimeAreNotCalledTheLargest) {
  const std::vector<ComparedSlump> two{slump_of("a", {{30.0, 0.050, 0.080}}),
                                       slump_of("b", {{30.0, 0.052, 0.080}})};
  const std::string html = slump_comparison_report(run_, two).html();
  EXPECT_NE(html.find("Heights differ at 30 s, by 2.00 mm (a, b). Toes differ at 30 s, by 0 mm (a, a)."),
            std::string::npos);
}

// by hand: M p_B0/4 [0.01 (1 - 0.03)/6.8e-7]^0.02 = 141.684 Pa; rho g h = 1337.354 9.81 0.14 = 1836.72 Pa
TEST_F(SlumpDifferences, GoWithTheStrengthAtTheRatesOfASlump) {
  const std::string html = slump_comparison_report(run_, slumps_).html();
  EXPECT_NE(html.find(">0.142</td>"), std::string::npos);
  EXPECT_NE(html.find(">0.0771</td>"), std::string::npos) << "over the stress at the foot of the mould";
  const nlohmann::ordered_json strengths = strengths_json(slumps_.front());
  ASSERT_EQ(strengths.size(), 3U);
  EXPECT_EQ(strengths[1]["rate_per_s"], 0.01);
  EXPECT_NEAR(strengths[1]["strength_kPa"].get<double>(), 0.141684, 1e-6);
}

TEST_F(SlumpDifferences, OfTheRatesOfStrengthAreSaid) {
  const auto html = [this](const std::vector<ComparedSlump>& slumps) {
    return slump_comparison_report(run_, slumps).html();
  };
  EXPECT_NE(html(slumps_).find("critical state at |D| = 6.80×10⁻⁷ 1/s"), std::string::npos);
  EXPECT_NE(html(slumps_).find("|D| of C_u (1/s) 6.8×10⁻⁷,"), std::string::npos) << "the same in all";
  std::vector<ComparedSlump> slumps = slumps_;
  slumps[1].result->initial.strength_rate = 0.01;
  EXPECT_NE(html(slumps).find("critical state at the |D| of its column"), std::string::npos);
  EXPECT_EQ(html(slumps).find("|D| of C_u (1/s) 6.8×10⁻⁷,"), std::string::npos);
}

TEST_F(SlumpDifferences, AreInResultJsonInMillimetres) {
  const nlohmann::ordered_json json = result_json(run_, slumps_)["differences"];
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[1]["time_s"], 30.0);
  EXPECT_NEAR(json[1]["height_mm"]["least"].get<double>(), 53.0, 1e-9);
  EXPECT_EQ(json[1]["height_mm"]["least_in"], "low");
  EXPECT_NEAR(json[1]["toe_mm"]["greatest"].get<double>(), 86.5, 1e-9);
  EXPECT_EQ(json[1]["toe_mm"]["greatest_in"], "low");
}

TEST_F(SlumpDifferences, OfOneThatEndedAreItsStrengthAlone) {
  std::vector<ComparedSlump> slumps{slumps_[0], slumps_[1]};
  slumps[1].result =
      tl::unexpected(mpm::SlumpFailure{mpm::SlumpFailure::Kind::left_grid, 1.0, 0.2, 0.0, "out"});
  const std::string html = slump_comparison_report(run_, slumps).html();
  EXPECT_EQ(html.find("Heights differ"), std::string::npos);
  EXPECT_NE(html.find("Undrained strength C_u (kPa) at the critical state"), std::string::npos);
}

}  // namespace
}  // namespace isotach::reports
