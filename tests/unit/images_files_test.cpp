// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Pictures as files: what is read, what is refused, and the times in their names.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "images/picture.hpp"
#include "images/time_stamp.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::images {
namespace {

using datasets::expect_input_error;
using datasets::TemporaryFolder;
using Files = std::vector<std::filesystem::path>;

constexpr std::uintmax_t kMegabyte = 1'000'000;

TEST(Picture, PixelsComeBackFromPng) {
  const TemporaryFolder folder;
  cv::Mat3b codes(70, 80, cv::Vec3b(10, 20, 30));
  codes(5, 6) = cv::Vec3b(1, 2, 3);
  cv::imwrite((folder.path() / "a.png").string(), codes);
  const Picture picture = read_picture(folder.path() / "a.png", kMegabyte);
  EXPECT_EQ(picture.codes.size(), codes.size());
  EXPECT_EQ(picture.codes(5, 6), codes(5, 6));
}

TEST(Picture, WhatIsNoPictureIsRefused) {
  const TemporaryFolder folder;
  const auto read = [&](const char* name, std::uintmax_t limit = kMegabyte) {
    return [&folder, name, limit] { (void)read_picture(folder.path() / name, limit); };
  };
  folder.write("text.png", "not a picture");
  folder.write("empty.png", "");
  folder.write("video.mp4", std::string("\0\0\0\x20"
                                        "ftypisom",
                                        12));
  cv::imwrite((folder.path() / "small.png").string(), cv::Mat3b(20, 300, cv::Vec3b()));
  expect_input_error(read("none.png"), {"none.png", "no such file"});
  expect_input_error([&] { (void)read_picture(folder.path(), kMegabyte); }, {"a folder"});
  expect_input_error(read("text.png"), {"text.png", "no picture", "PNG"});
  expect_input_error(read("empty.png"), {"empty.png", "no picture"});
  expect_input_error(read("video.mp4"), {"video.mp4", "ffmpeg"});
  expect_input_error(read("small.png"), {"small.png", "300 by 20", "64"});
  expect_input_error(read("text.png", 5), {"text.png", "13 bytes", "--max-file-mb"});
}

TEST(Picture, AreasOutsideOfThePictureAreRefused) {
  const Picture picture{"p.png", cv::Mat3b(100, 200, cv::Vec3b())};
  EXPECT_EQ(looked_area(picture, {}).width, 200);
  EXPECT_EQ(looked_area(picture, {.region = PixelArea{20, 10, 180, 90}}).row, 10);
  for (const PixelArea& area :
       {PixelArea{-1, 0, 100, 100}, {0, 0, 201, 100}, {101, 0, 100, 100}, {0, 0, 100, 0}}) {
    expect_input_error([&] { (void)looked_area(picture, {.region = area}); }, {"--region", "200 by 100"});
    expect_input_error([&] { (void)looked_area(picture, {.ignored = {area}}); }, {"--ignore"});
  }
  expect_input_error(
      [&] {
        (void)looked_area(picture, {.region = PixelArea{0, 0, 63, 100}});
      },
      {"--region", "64"});
}

TEST(Picture, LightFollowsTheCurveOfSrgb) {
  // IEC 61966-2-1: code 188 of 255 is half of the light, to a code; black and white stay
  const cv::Mat3f light = light_of(cv::Mat3b(1, 1, cv::Vec3b(0, 188, 255)));
  EXPECT_EQ(light(0, 0)[0], 0.0F);
  EXPECT_NEAR(light(0, 0)[1], 0.5, 0.006);
  EXPECT_NEAR(light(0, 0)[2], 1.0, 1e-6);
}

TEST(TimeStamp, SecondsAreReadFromNames) {
  EXPECT_EQ(time_stamps({"dir.9s/slump-5.2s.png", "t=15s_left.jpg", "mud 30 s.tif"}, {}),
            (std::vector<double>{5.2, 15.0, 30.0}));
  EXPECT_EQ(time_stamps({"a_t12.5_x.png"}, {.pattern = "t([0-9.]+)_"}), std::vector<double>{12.5});
  EXPECT_EQ(time_stamps({"a-7s.png"}, {.start = 2.0}), std::vector<double>{5.0});
}

TEST(TimeStamp, FramesBecomeSecondsByTheirRate) {
  const TimeRule rule{.frames_per_second = 25.0, .start = 50.0};
  EXPECT_EQ(time_stamps({"test2_frame_0075.png", "test2_frame_0100.png"}, rule),
            (std::vector<double>{1.0, 2.0}));
}

TEST(TimeStamp, NamesWithoutATimeAndTimesThatCannotBeAreRefused) {
  const auto stamps = [](Files files, TimeRule rule) {
    return [files, rule] { (void)time_stamps(files, rule); };
  };
  expect_input_error(stamps({"slump.png"}, {}), {"slump.png", "--time-pattern", "--frames-per-second"});
  expect_input_error(stamps({"5slump.png"}, {}), {"5slump.png"});
  expect_input_error(stamps({"a-0s.png"}, {}), {"a-0s.png", "> 0"});
  expect_input_error(stamps({"a-3s.png"}, {.start = 3.0}), {"a-3s.png", "> 0"});
  expect_input_error(stamps({"a-3s.png", "b-3s.png"}, {}), {"b-3s.png", "as of a-3s.png"});
  expect_input_error(stamps({"a-3s.png"}, {.pattern = "(["}), {"--time-pattern", "regular expression"});
  expect_input_error(stamps({"a-3s.png"}, {.pattern = "[0-9]"}), {"--time-pattern", "no group"});
  expect_input_error(stamps({"a-xs.png"}, {.pattern = "-(.)s"}), {"a-xs.png", "\"x\"", "a number"});
}

}  // namespace
}  // namespace isotach::images
