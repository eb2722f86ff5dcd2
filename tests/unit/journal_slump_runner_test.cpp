// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a run returns is the same from an empty journal, a full one and none; what failed is kept as it
// failed.
#include <gtest/gtest.h>

#include "journal/slump_runner.hpp"
#include "mpm/code_version.hpp"
#include "tests/unit/datasets_files.hpp"
#include "tests/unit/journal_rows.hpp"

namespace isotach::journal {
namespace {

using mpm::RunStatus;

class SlumpRunnerTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "journal.sqlite"; }
  [[nodiscard]] static std::string key_of(const mpm::SlumpSetup& setup) {
    return Inputs(tests::seed_mud(), setup, mpm::code_version()).key;
  }

  datasets::TemporaryFolder folder_;
  Journal journal_{file()};
};

TEST_F(SlumpRunnerTest, TheSecondRunIsTheFirst) {
  const auto plain = SlumpRunner(nullptr).run("a", tests::seed_mud(), small_setup());
  ASSERT_TRUE(plain.has_value());
  SlumpRunner runner(&journal_);
  const auto first = runner.run("a", tests::seed_mud(), small_setup());
  const auto second = runner.run("renamed", tests::seed_mud(), small_setup());
  EXPECT_EQ(runner.simulated(), 1);
  EXPECT_EQ(runner.reused(), 1);
  ASSERT_TRUE(first.has_value() && second.has_value());
  EXPECT_EQ(bytes_of(*first), bytes_of(*plain));
  EXPECT_EQ(bytes_of(*second), bytes_of(*plain));
}

TEST_F(SlumpRunnerTest, AnotherCellSizeOrMudIsAnotherRun) {
  SlumpRunner runner(&journal_);
  static_cast<void>(runner.run("a", tests::seed_mud(), small_setup()));
  mpm::SlumpSetup finer = small_setup();
  finer.numerics.cell_size = 0.0098;
  static_cast<void>(runner.run("a", tests::seed_mud(), finer));
  static_cast<void>(runner.run("a", tests::seed_mud_with(model::ParameterId::I_v, 0.021), small_setup()));
  EXPECT_EQ(runner.simulated(), 3);
  EXPECT_EQ(runner.reused(), 0);
}

TEST_F(SlumpRunnerTest, ARunOfAnotherVersionIsNotTaken) {
  Evaluation other = row_number(1);
  other.inputs = Inputs(tests::seed_mud(), small_setup(), mpm::code_version() + " and one day");
  journal_.put(other);
  SlumpRunner runner(&journal_);
  static_cast<void>(runner.run("a", tests::seed_mud(), small_setup()));
  EXPECT_EQ(runner.simulated(), 1);
}

TEST_F(SlumpRunnerTest, ATimeOutIsKeptAndTriedAgainOnlyWithMoreTime) {
  mpm::SlumpSetup setup = small_setup();
  setup.numerics.cell_size = 0.004;  // some thousand steps: time is looked at every 256
  for (const int repeat : {1, 2}) {
    SlumpRunner runner(&journal_, {.limits = {1e-6, nullptr}});
    const auto result = runner.run("a", tests::seed_mud(), setup);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().status, RunStatus::timed_out);
    EXPECT_NE(result.error().message.find("limit of 1e-06 s"), std::string::npos) << result.error().message;
    EXPECT_EQ(runner.simulated(), repeat == 1 ? 1 : 0);
  }
  const auto row = journal_.get(key_of(setup));
  ASSERT_TRUE(row.has_value());
  EXPECT_EQ(row->status, RunStatus::timed_out);
  EXPECT_EQ(row->time_limit, 1e-6);
  SlumpRunner patient(&journal_, {.limits = {600.0, nullptr}});
  EXPECT_TRUE(patient.run("a", tests::seed_mud(), setup).has_value());
  EXPECT_EQ(patient.simulated(), 1);
  EXPECT_NE(journal_.get(key_of(setup))->status, RunStatus::timed_out);
}

// The wet mud spreads to 63 mm.
TEST_F(SlumpRunnerTest, MudThatReachesTheEdgeOfTheSlabIsKeptAsOutsideTheDomain) {
  mpm::SlumpSetup setup = small_setup();
  setup.base.slab = mpm::ElasticSlab{};
  setup.base.slab->length = 0.055;
  setup.times = {1.0};
  const auto result = SlumpRunner(&journal_).run("a", tests::seed_mud(), setup);
  ASSERT_FALSE(result.has_value());
  const auto row = journal_.get(key_of(setup));
  ASSERT_TRUE(row.has_value());
  EXPECT_EQ(row->status, RunStatus::outside_domain);
  EXPECT_EQ(row->message, result.error().message);
  EXPECT_NE(row->message.find("beyond what it rests on"), std::string::npos) << row->message;
}

// A tenth of a second after the mould has let it go, wet mud falls; after ten seconds it creeps.
TEST_F(SlumpRunnerTest, MudThatStillFallsIsNotSettledAndAResultAllTheSame) {
  mpm::SlumpSetup setup = small_setup();
  SlumpRunner runner(&journal_);
  EXPECT_TRUE(runner.run("a", tests::seed_mud(), setup).has_value());
  EXPECT_EQ(journal_.get(key_of(setup))->status, RunStatus::not_settled);
  setup.times.push_back(10.0);
  EXPECT_TRUE(runner.run("a", tests::seed_mud(), setup).has_value());
  EXPECT_EQ(journal_.get(key_of(setup))->status, RunStatus::ok);
}

TEST_F(SlumpRunnerTest, AnInterruptedRunIsNotKept) {
  const std::atomic<bool> stop{true};
  mpm::SlumpSetup setup = small_setup();
  setup.numerics.cell_size = 0.004;
  SlumpRunner runner(&journal_, {.limits = {600.0, &stop}});
  const auto result = runner.run("a", tests::seed_mud(), setup);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().status, RunStatus::interrupted);
  EXPECT_EQ(journal_.counts().total(), 0);
  EXPECT_EQ(runner.simulated(), 0);
}

TEST_F(SlumpRunnerTest, AJournalThatFailsOnTheWayDoesNotEndTheFit) {
  SlumpRunner runner(&journal_);
  Database(file(), SQLITE_OPEN_READWRITE, 1.0).execute("DROP TABLE evaluation");
  EXPECT_TRUE(runner.run("a", tests::seed_mud(), small_setup()).has_value());
  EXPECT_NE(runner.trouble().find(file().string()), std::string::npos) << runner.trouble();
}

}  // namespace
}  // namespace isotach::journal
