// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a file of candidates gives, and what it may not.
#include <gtest/gtest.h>

#include "datasets/candidates.hpp"
#include "datasets/input_error.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::datasets {
namespace {

Study study() {
  SlumpTest test{"present", {}, {}, {}, {}, false};
  test.setup.mud.void_ratio = 4.2;
  test.setup.numerics.cell_size = 0.0065;
  return {.file = {},
          .material = tests::seed_mud(),
          .fit = {},
          .oedometer_tests = {},
          .slump_tests = {test},
          .assumptions = {}};
}

Candidates parsed(const std::string& text) {
  return parse_candidates(text, "candidates.toml", study());
}

void expect_refused(const std::string& text, std::initializer_list<std::string_view> parts) {
  try {
    static_cast<void>(parsed(text));
    ADD_FAILURE() << "accepted: " << text;
  } catch (const InputError& error) {
    for (const std::string_view part : parts) {
      EXPECT_NE(std::string_view(error.what()).find(part), std::string_view::npos)
          << "\"" << part << "\" is not in: " << error.what();
    }
  }
}

TEST(Candidates, TheBuiltInTableIsAFileLikeAnyOther) {
  const Candidates candidates = parsed(std::string(default_candidates()));
  std::size_t programme = 0;
  for (const CandidateSlump& slump : candidates.slumps) programme += slump.programme.empty() ? 0U : 1U;
  EXPECT_EQ(programme, 8U) << "the eight tests of table 1";
  EXPECT_EQ(candidates.oedometers.size(), 7U);
  EXPECT_GT(candidates.count(), 40U);
}

TEST(Candidates, AGridIsEveryCombinationWithTheStudysMudAndCells) {
  const Candidates candidates = parsed(R"([pictures]
early = [0.5, 1.0]
late = [1.0, 30.0]
[[slump_grid]]
diameter_mm = 78.0
fill_heights_mm = [70.0, 140.0]
lift_speeds_m_per_s = [0.01, 0.06]
walls = ["rough"]
wall_adhesions_kPa = [0.02]
pictures = ["early", "late"]
)");
  ASSERT_EQ(candidates.slumps.size(), 8U);
  EXPECT_EQ(candidates.count(), 16U);
  for (const CandidateSlump& slump : candidates.slumps) {
    EXPECT_EQ(slump.setup.mud.void_ratio, 4.2);
    EXPECT_EQ(slump.setup.numerics.cell_size, 0.0065);
    EXPECT_EQ(slump.setup.times, (std::vector<double>{0.5, 1.0, 30.0}));
  }
  EXPECT_TRUE(candidates.slumps[0].setup.mould.wall.is_rough());
  EXPECT_DOUBLE_EQ(candidates.slumps[1].setup.mould.wall.adhesion, 20.0);
}

TEST(Candidates, StagesLoadUnloadAndRelaxByTheirStrains) {
  const Candidates candidates = parsed(R"([[oedometer]]
name = "one"
void_ratio = 2.5
stages = [{ to_strain = 0.2, rate_per_s = 1e-6 }, { to_strain = 0.1, rate_per_s = 1e-5 }, { relax_s = 100.0 }]
)");
  ASSERT_EQ(candidates.oedometers.size(), 1U);
  const auto& stages = candidates.oedometers[0].stages;
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[0].stage, Stage::load);
  EXPECT_EQ(stages[1].stage, Stage::unload);
  EXPECT_EQ(stages[2].stage, Stage::relax);
  EXPECT_EQ(stages[2].strain, 0.1);
}

TEST(Candidates, MistakesAreNamedWithTheirPlace) {
  expect_refused("[pictures]\nearly = [1.0]\n", {"candidates.toml", "there is none"});
  expect_refused("[pictures]\nearly = [2.0, 1.0]\n", {":2", "early", "1 follows 2"});
  const std::string mould =
      "mould = { diameter_mm = 78.0, fill_height_mm = 70.0, lift_speed_m_per_s = 0.06, wall = \"smooth\" }\n";
  expect_refused("[[slump]]\nname = \"a\"\npictures = [\"noon\"]\n" + mould, {":3", "noon", "[pictures]"});
  expect_refused("[[slump]]\nname = \"a\"\n" + mould, {"pictures", "it is missing"});
  expect_refused("[[slump]]\nname = \"a\"\ntimes_s = [1.0]\ncolour = 1\n" + mould, {":4", "colour"});
  expect_refused("[[oedometer]]\nname = \"a\"\n", {"stages", "there is none"});
  expect_refused("[[oedometer]]\nname = \"a\"\nstages = [{ to_strain = 0.1 }]\n", {"rate_per_s"});
}

TEST(Candidates, WithoutASlumpTestInTheStudyAMudMustBeGiven) {
  Study bare = study();
  bare.slump_tests.clear();
  EXPECT_THROW(
      static_cast<void>(parse_candidates("[[slump]]\nname = \"a\"\ntimes_s = [1.0]\nmould = { diameter_mm "
                                         "= 78.0, fill_height_mm = 70.0, lift_speed_m_per_s = 0.06 }\n",
                                         "c.toml", bare)),
      InputError);
}

}  // namespace
}  // namespace isotach::datasets
