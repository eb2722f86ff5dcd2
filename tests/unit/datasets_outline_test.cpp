// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// read_outlines: points and times, and what it refuses.
#include <gtest/gtest.h>

#include "datasets/outline.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

class OutlineFile : public testing::Test {
 protected:
  std::vector<Outline> read(std::string_view content) const {
    return read_outlines(folder_.write("slump.csv", content));
  }
  void expect_refused(std::string_view content, std::initializer_list<std::string_view> parts) const {
    expect_input_error([&] { static_cast<void>(read(content)); }, parts);
  }

  TemporaryFolder folder_;
};

TEST_F(OutlineFile, KeepsTheOrderOfTheFileInMetres) {
  const auto outlines =
      read("time_s,r_mm,z_mm\n0.5,90,2\n0.5,40,30\n0.5,-0.4,60\n1,91,2\n1,41,-0.3\n1,0,59\n1,0,58\n");
  ASSERT_EQ(outlines.size(), 2U);
  EXPECT_EQ(outlines[0].time, 0.5);
  ASSERT_EQ(outlines[0].points.size(), 3U);
  EXPECT_DOUBLE_EQ(outlines[0].points[0].r, 0.09);
  EXPECT_DOUBLE_EQ(outlines[0].points[0].z, 0.002);
  EXPECT_DOUBLE_EQ(outlines[0].points[2].r, -0.0004);
  EXPECT_EQ(outlines[1].points.size(), 4U);
}

TEST_F(OutlineFile, ATimeThatDecreasesIsRefused) {
  expect_refused("time_s,r_mm,z_mm\n1,9,2\n1,4,3\n1,0,6\n0.5,9,2\n",
                 {"slump.csv:5: column time_s: 0.5 after 1", "do not decrease"});
}

TEST_F(OutlineFile, ATimeThatIsNotPositiveIsRefused) {
  expect_refused("time_s,r_mm,z_mm\n0,9,2\n",
                 {"slump.csv:2: column time_s: \"0\" is out of range; accepted: > 0"});
}

TEST_F(OutlineFile, ACoordinateFarOnTheWrongSideIsRefused) {
  expect_refused("time_s,r_mm,z_mm\n1,-6,2\n", {"slump.csv:2: column r_mm: \"-6\"", ">= -5"});
  expect_refused("time_s,r_mm,z_mm\n1,6,-5.5\n", {"slump.csv:2: column z_mm: \"-5.5\"", ">= -5"});
}

TEST_F(OutlineFile, FewerThanThreePointsAtATimeAreRefused) {
  expect_refused("time_s,r_mm,z_mm\n1,9,2\n1,4,3\n2,9,2\n2,4,3\n2,0,3\n", {"slump.csv:3", "1 s", "2 points"});
  expect_refused("time_s,r_mm,z_mm\n1,9,2\n1,4,3\n1,0,4\n2,9,2\n",
                 {"slump.csv:5", "2 s", "1 points", "at least 3"});
}

TEST_F(OutlineFile, AMissingColumnIsRefused) {
  expect_refused("time_s,r_mm,z\n1,9,2\n", {"slump.csv:1", "column z_mm is missing", "time_s, r_mm, z"});
}

}  // namespace
}  // namespace isotach::datasets
