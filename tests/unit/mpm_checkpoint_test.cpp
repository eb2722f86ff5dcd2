// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A run that stops halfway and goes on is the run that did not stop, to the last byte.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "mpm/archive.hpp"
#include "mpm/checkpoint.hpp"
#include "mpm/slump.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::mpm {
namespace {

class CheckpointTest : public testing::Test {
 protected:
  CheckpointTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("isotach-checkpoint-" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))),
        file_(folder_ / "run.checkpoint") {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    setup_.numerics.cell_size = 0.0078;
    setup_.mud.void_ratio = 3.891;
    setup_.times = {0.1, 0.25, 0.4};
  }
  ~CheckpointTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] RunOptions options() const {
    RunOptions result;
    result.snapshots = true;
    result.frames = 12;
    return result;
  }
  /// All that a run yields, as bytes.
  static std::string bytes_of(SlumpResult result) {
    Archive archive;
    archive(result);
    archive(result.steps);
    archive(result.substepped);
    return archive.bytes();
  }
  /// Runs until progress was reported `reports` times.
  void interrupt_after(int reports) {
    std::atomic<bool> stop = false;
    RunOptions interrupted = options();
    interrupted.checkpoint = file_;
    interrupted.stop = &stop;
    interrupted.progress = [&](double, double) {
      if (--reports <= 0) stop = true;
    };
    const auto result = run_slump(tests::seed_mud(), setup_, interrupted);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().kind, SlumpFailure::Kind::interrupted);
  }

  std::filesystem::path folder_;
  std::filesystem::path file_;
  SlumpSetup setup_;
};

TEST_F(CheckpointTest, ARunThatWasInterruptedGoesOnAsIfItHadNot) {
  const auto whole = run_slump(tests::seed_mud(), setup_, options());
  ASSERT_TRUE(whole.has_value());
  interrupt_after(1);
  ASSERT_TRUE(std::filesystem::exists(file_));
  interrupt_after(2);  // and once more
  ASSERT_TRUE(std::filesystem::exists(file_));
  RunOptions resumed = options();
  resumed.checkpoint = file_;
  long reports = 0;
  resumed.progress = [&](double, double done) {
    ++reports;
    EXPECT_GT(done, 0.0);
    EXPECT_LE(done, 1.0);
  };
  const auto rest = run_slump(tests::seed_mud(), setup_, resumed);
  ASSERT_TRUE(rest.has_value());
  EXPECT_LT(reports, whole->steps / 256) << "it began anew";
  EXPECT_EQ(bytes_of(*rest), bytes_of(*whole));
  EXPECT_FALSE(std::filesystem::exists(file_)) << "a run that is over leaves no checkpoint";
}

TEST_F(CheckpointTest, AnElasticBaseGoesOnWithTheMud) {
  setup_.base.slab = ElasticSlab{};
  const auto whole = run_slump(tests::seed_mud(), setup_, options());
  ASSERT_TRUE(whole.has_value());
  interrupt_after(1);
  RunOptions resumed = options();
  resumed.checkpoint = file_;
  const auto rest = run_slump(tests::seed_mud(), setup_, resumed);
  ASSERT_TRUE(rest.has_value());
  EXPECT_EQ(bytes_of(*rest), bytes_of(*whole));
  SlumpSetup other = setup_;
  other.base.slab->youngs_modulus *= 2.0;
  const auto key = [&](const SlumpSetup& setup) { return run_key(tests::seed_mud(), setup, true, true, 12); };
  EXPECT_NE(key(other), key(setup_));
  other.base.slab.reset();
  EXPECT_NE(key(other), key(setup_));
}

TEST_F(CheckpointTest, WhatBelongsToAnotherRunOrIsNotWholeIsNotUsed) {
  const std::uint64_t key = run_key(tests::seed_mud(), setup_, true, false, 0);
  ASSERT_TRUE(write_checkpoint(file_, key, "state"));
  EXPECT_EQ(read_checkpoint(file_, key), "state");
  SlumpSetup other = setup_;
  other.mould.lift_delay = 1e-9;
  EXPECT_NE(run_key(tests::seed_mud(), other, true, false, 0), key);
  EXPECT_NE(run_key(tests::seed_mud(), setup_, false, false, 0), key);
  EXPECT_NE(run_key(tests::seed_mud(), setup_, true, false, 60), key);
  EXPECT_FALSE(read_checkpoint(file_, run_key(tests::seed_mud(), other, true, false, 0)).has_value());
  EXPECT_FALSE(read_checkpoint(folder_ / "none", key).has_value());
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 1);
  EXPECT_FALSE(read_checkpoint(file_, key).has_value());
  std::ofstream(file_) << "something else";
  EXPECT_FALSE(read_checkpoint(file_, key).has_value());
}

TEST_F(CheckpointTest, WithoutAFileNothingIsWritten) {
  ASSERT_TRUE(run_slump(tests::seed_mud(), setup_, options()).has_value());
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST(Archive, GivesBackWhatItTookAndNoticesWhatIsMissing) {
  std::vector<double> numbers{1.0, 2.0};
  long count = 7;
  Archive saved;
  saved(numbers);
  saved(count);
  std::vector<double> got;
  long got_count = 0;
  Archive loaded(saved.bytes());
  loaded(got);
  loaded(got_count);
  EXPECT_TRUE(loaded.complete());
  EXPECT_EQ(got, numbers);
  EXPECT_EQ(got_count, 7);
  Archive cut(std::string_view(saved.bytes()).substr(0, 12));
  cut(got);
  cut(got_count);
  EXPECT_FALSE(cut.complete());
}

}  // namespace
}  // namespace isotach::mpm
