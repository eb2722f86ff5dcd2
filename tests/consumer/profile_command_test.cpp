// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach profile from pictures to results: what it writes, that it can be fitted, and what it refuses.
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "bench/rendered_slump.hpp"
#include "datasets/outline.hpp"
#include "tests/consumer/consumer_test.hpp"

namespace isotach::consumer {
namespace {

using nlohmann::json;
using rendered::cap;
using rendered::Scene;

class ProfileCommand : public ConsumerTest {
 protected:
  void write_picture(const std::string& name, const Scene& scene) const {
    ASSERT_TRUE(cv::imwrite((folder() / name).string(), render(scene)));
  }
  /// Caps of 572.6 ml (half of pi 90^2 45 mm3) and of the same volume, wider, on 0.4 mm a pixel.
  void write_two() const {
    write_picture("slump-15s.png", small(cap(0.095, 0.045 * 0.090 * 0.090 / (0.095 * 0.095))));
    write_picture("slump-2.5s.png", small(cap(0.090, 0.045)));
  }
  [[nodiscard]] static Scene small(const rendered::Outline& outline) {
    return {.outline = outline,
            .pixel = 0.4e-3,
            .width = 600,
            .height = 280,
            .axis_column = 300.2,
            .base_row = 235.4};
  }
  [[nodiscard]] json result(std::string_view out) const {
    return json::parse(content_of(folder() / out / "result.json"));
  }
};

TEST_F(ProfileCommand, WritesAllResults) {
  write_two();
  const Ended ended = run({"profile", "slump-15s.png", "slump-2.5s.png", "--scale-mm-per-pixel", "0.4",
                           "--mould-volume-ml", "572.6", "--out", "new/results", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out + ended.err, "");
  EXPECT_EQ(everything(),
            (std::vector<std::string>{
                "new", "new/results", "new/results/history.csv", "new/results/outlines.csv",
                "new/results/overlays", "new/results/overlays/slump-15s.png",
                "new/results/overlays/slump-2.5s.png", "new/results/report.html", "new/results/result.json",
                "new/results/sides.csv", "slump-15s.png", "slump-2.5s.png"}));
  const json written = result("new/results");
  EXPECT_EQ(written.at("command"), "profile");
  EXPECT_EQ(written.at("status"), "ok");
  ASSERT_EQ(written.at("outlines").size(), 2);
  EXPECT_EQ(written.at("outlines")[0].at("time_s"), 2.5);
  EXPECT_NEAR(written.at("outlines")[0].at("height_mm").get<double>(), 45.0, 0.5);
  EXPECT_NEAR(written.at("outlines")[0].at("toe_mm").get<double>(), 90.0, 0.5);
  EXPECT_NEAR(written.at("pictures")[1].at("volume_ml").get<double>(), 572.6, 0.02 * 572.6);
  EXPECT_LT(std::abs(written.at("pictures")[1].at("volume_error").get<double>()), 0.02);

  // the outlines are data of a study as they stand
  const auto outlines = datasets::read_outlines(folder() / "new/results/outlines.csv");
  ASSERT_EQ(outlines.size(), 2);
  EXPECT_EQ(outlines[0].time, 2.5);
  EXPECT_EQ(outlines[0].points.front().z, 0.0);
  EXPECT_EQ(outlines[0].points.back().r, 0.0);
  EXPECT_TRUE(content_of(folder() / "new/results/sides.csv")
                  .starts_with(
                      "time_s,r_mm,z_mm,half_difference_mm,left_r_mm,left_z_mm,right_r_mm,right_z_mm\n2.5,"));
  const std::string report = content_of(folder() / "new/results/report.html");
  EXPECT_NE(report.find("data:image/jpeg;base64,"), std::string::npos);
  const cv::Mat overlay = cv::imread((folder() / "new/results/overlays/slump-15s.png").string());
  EXPECT_EQ(overlay.cols, 600);
}

TEST_F(ProfileCommand, SameInputGivesTheSameOutlinesWhateverTheThreads) {
  write_two();
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(run({"profile", "slump-15s.png", "slump-2.5s.png", "--scale-mm-per-pixel", "0.4", "--threads",
                   threads, "--out", threads})
                  .code,
              0);
  }
  for (const char* file : {"outlines.csv", "sides.csv", "report.html", "overlays/slump-15s.png"}) {
    EXPECT_EQ(content_of(folder() / "1" / file), content_of(folder() / "2" / file)) << file;
  }
}

TEST_F(ProfileCommand, ARefusedPictureIsNamedAndTheOthersGoOn) {
  write_two();
  write_picture("cut-30s.png", [] {
    Scene scene = small(cap(0.090, 0.045));
    scene.axis_column = 150.0;
    return scene;
  }());
  const Ended ended =
      run({"profile", "slump-2.5s.png", "cut-30s.png", "--scale-mm-per-pixel", "0.4", "--out", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.err.find("cut-30s.png was refused: "), std::string::npos) << ended.err;
  const json written = result("out");
  EXPECT_EQ(written.at("outlines").size(), 1);
  EXPECT_EQ(written.at("pictures")[1].at("status"), "refused");
  EXPECT_EQ(written.at("pictures")[1].at("reason"), "cut-by-border");
  EXPECT_EQ(written.at("warnings").size(), 1);
}

TEST_F(ProfileCommand, NothingIsWrittenWhereEveryPictureIsRefused) {
  write_two();
  const std::vector<std::string> pictures{"profile", "slump-2.5s.png", "slump-15s.png",
                                          "--scale-mm-per-pixel", "0.4"};
  std::vector<std::string> too_small = pictures;
  for (const char* word : {"--mould-volume-ml", "700", "--quiet"}) too_small.emplace_back(word);
  expect_refused(too_small, {"slump-2.5s.png: refused", "-18.", "700.0 ml", "5 %", "1 more"});
  for (const char* word : {"--volume-limit-percent", "25", "--out", "wider"}) too_small.emplace_back(word);
  EXPECT_EQ(run(too_small).code, 0);
}

TEST_F(ProfileCommand, ScaleByMouldPictureAndByReferenceLengthAgree) {
  write_two();
  write_picture("mould.png", small({{0.041, 0.0}, {0.041, 0.07}, {0.0, 0.07}}));
  ASSERT_EQ(run({"profile", "slump-15s.png", "--mould-picture", "mould.png", "--mould-diameter-mm", "78",
                 "--mould-wall-mm", "2", "--out", "mould"})
                .code,
            0);
  ASSERT_EQ(run({"profile", "slump-15s.png", "--reference-length-mm", "82", "--reference-points", "197.7,200",
                 "402.7,200", "--out", "length"})
                .code,
            0);
  const double by_mould = result("mould").at("outlines")[0].at("toe_mm").get<double>();
  EXPECT_NEAR(by_mould, 95.0, 0.5);
  EXPECT_NEAR(by_mould, result("length").at("outlines")[0].at("toe_mm").get<double>(), 0.3);
}

TEST_F(ProfileCommand, FramesGetTheirTimesFromTheRate) {
  write_picture("frame_0130.png", small(cap(0.090, 0.045)));
  const Ended ended = run({"profile", "frame_0130.png", "--frames-per-second", "25", "--start-frame", "30",
                           "--scale-mm-per-pixel", "0.4", "--out", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(result("out").at("outlines")[0].at("time_s"), 4.0);
}

TEST_F(ProfileCommand, MistakesOnTheLineAreRefused) {
  write_two();
  write("text-3s.png", "no picture");
  cv::imwrite((folder() / "other-4s.png").string(), cv::Mat3b(300, 300, cv::Vec3b(200, 200, 200)));
  const std::string image = "slump-15s.png";
  const auto refuse = [&](std::vector<std::string> options, std::initializer_list<std::string_view> parts) {
    options.insert(options.begin(), {"profile", image});
    expect_refused(options, parts);
  };
  refuse({}, {"scale", "--scale-mm-per-pixel"});
  refuse({"--scale-mm-per-pixel", "0.4", "--reference-length-mm", "5"}, {"2 of the ways"});
  refuse({"--reference-length-mm", "5"}, {"--reference-points"});
  refuse({"--reference-length-mm", "5", "--reference-points", "1,2", "3;4"},
         {"--reference-points", "\"3;4\""});
  refuse({"--reference-length-mm", "5", "--reference-points", "1,2", "1,2"}, {"a pixel apart"});
  refuse({"--rectangle", "0,0", "9,0", "9,9", "0,9"}, {"--rectangle-size-mm"});
  refuse({"--rectangle", "9,0", "0,0", "9,9", "0,9", "--rectangle-size-mm", "100,50"},
         {"convex", "upper left"});
  refuse({"--circle-point", "1,2", "--circle-diameter-mm", "100"}, {"--camera-distance-mm"});
  refuse({"--circle-point", "1,2", "--circle-diameter-mm", "100", "--circle-on", "plane"}, {"5 or more"});
  refuse({"--mould-picture", image}, {"--mould-diameter-mm"});
  refuse({"--scale-mm-per-pixel", "0.4", "--fill-height-mm", "70"}, {"--mould-diameter-mm"});
  refuse({"--scale-mm-per-pixel", "0.4", "--region", "0,0,900,100"}, {"--region", "600 by 280"});
  refuse({"--scale-mm-per-pixel", "0.4", "--ignore", "0,0,1.5,100"}, {"--ignore", "whole pixels"});
  refuse({"--scale-mm-per-pixel", "0.4", "--base-row", "-3"}, {"--base-row", "0 to 279"});
  refuse({"--scale-mm-per-pixel", "0.4", "--base-row", "0"}, {"refused"});
  refuse({"--scale-mm-per-pixel", "0.4", "--axis-column", "600"}, {"--axis-column", "0 to 599"});
  refuse({"--scale-mm-per-pixel", "0.4", "--ignore", "0,0,600,280"}, {"refused"});
  refuse({"--scale-mm-per-pixel", "0.4", "--start-frame", "3"}, {"--start-s"});
  refuse({"text-3s.png", "--scale-mm-per-pixel", "0.4"}, {"text-3s.png", "no picture"});
  refuse({"other-4s.png", "--scale-mm-per-pixel", "0.4"}, {"other-4s.png", "300 by 300"});
  refuse({"none-4s.png", "--scale-mm-per-pixel", "0.4"}, {"none-4s.png", "no such file"});
}

}  // namespace
}  // namespace isotach::consumer
