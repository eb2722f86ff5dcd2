// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines read from rendered pictures are those that were rendered, whatever spoils the pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/rendered_slump.hpp"
#include "images/profile.hpp"
#include "tests/outline_error.hpp"

namespace isotach::images {
namespace {

using rendered::cap;
using rendered::collar;
using rendered::error_of;
using rendered::Outline;
using rendered::OutlineError;
using rendered::Scene;

// At 0.2 mm a pixel: what the laboratory asks for, and what it gets of points and of their mean square.
constexpr double kLargestError = 0.5e-3;  // m
constexpr double kRmsError = 0.1e-3;
// A true edge between two points of an outline is cut off; that is the spacing's error, not the reading's.
constexpr double kSpacing = 0.5e-3;  // m

struct Shape {
  const char* name;
  Outline outline;
};

/// A spread cap with a foot of 45 degrees, one with a steep foot and a flat top, and a collar with an edge on
/// top.
std::vector<Shape> shapes() {
  return {{"parabola", cap(0.090, 0.045)},
          {"steep", cap(0.070, 0.060, 4.0)},
          {"collar", collar(0.055, 0.039, 0.070)}};
}

PictureOutcome outcome_of(const Scene& scene, const ProfileOptions& options = {}) {
  const Picture picture{"rendered.png", render(scene)};
  return read_profile(picture, level_view(scene.pixel, picture.codes.size(), {}), options);
}

Reading reading_of(const Scene& scene, const ProfileOptions& options = {}) {
  PictureOutcome outcome = outcome_of(scene, options);
  if (!outcome.reading) {
    ADD_FAILURE() << "refused: " << outcome.reading.error().message;
    return {};
  }
  return *outcome.reading;
}

OutlineError error_in(const Scene& scene) {
  return error_of(reading_of(scene, {.spacing = kSpacing}).outline.points, scene.outline);
}

void expect_accurate(const Scene& scene, const std::string& what) {
  const OutlineError error = error_in(scene);
  EXPECT_LE(error.largest, kLargestError) << what;
  EXPECT_LE(error.rms, kRmsError) << what;
  EXPECT_LE(error.missed, kLargestError) << what;
}

void expect_refused(const Scene& scene, Refusal::Kind kind, std::string_view part,
                    const ProfileOptions& options = {}) {
  const PictureOutcome outcome = outcome_of(scene, options);
  ASSERT_FALSE(outcome.reading.has_value());
  EXPECT_STREQ(name_of(outcome.reading.error().kind), name_of(kind)) << outcome.reading.error().message;
  EXPECT_NE(outcome.reading.error().message.find(part), std::string::npos) << outcome.reading.error().message;
}

/// One thing that spoils a picture.
struct Spoiler {
  const char* name;
  std::function<void(Scene&)> spoil;
};

const std::vector<Spoiler> kSpoilers{
    {"nothing", [](Scene&) {}},
    {"noise of 6 codes", [](Scene& scene) { scene.noise = 6.0; }},
    {"light falling by 60 %", [](Scene& scene) { scene.uneven = 0.6; }},
    {"a camera rolled by 1.7 degrees", [](Scene& scene) { scene.roll = 0.03; }},
    {"sandpaper", [](Scene& scene) { scene.grains = 0.3; }},
    {"blur of 2 pixels", [](Scene& scene) { scene.blur = 2.0; }},
    {"a shadow on the background", [](Scene& scene) { scene.shadow = 0.3; }},
    {"a base darker than the mud", [](Scene& scene) { scene.base_light = 0.06; }},
    {"a base as the background", [](Scene& scene) { scene.base = false; }},
    {"mud lighter than the background", [](Scene& scene) {
       scene.mud_light = 0.8;
       scene.background_light = 0.15;
     }}};

class ProfileOfShape : public testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static Shape shape() { return shapes()[static_cast<std::size_t>(GetParam())]; }
};
INSTANTIATE_TEST_SUITE_P(Shapes, ProfileOfShape, testing::Range(0, 3));

TEST_P(ProfileOfShape, IsFoundWhateverSpoilsThePicture) {
  for (const Spoiler& spoiler : kSpoilers) {
    Scene scene{.outline = shape().outline};
    spoiler.spoil(scene);
    expect_accurate(scene, std::string(shape().name) + ", " + spoiler.name);
  }
}

TEST_P(ProfileOfShape, IsFoundWithAllSpoilersTogether) {
  std::uint64_t seed = static_cast<std::uint64_t>(10 * GetParam());
  for (const double sign : {-1.0, 1.0}) {
    const Scene scene{.outline = shape().outline,
                      .roll = sign * 0.025,
                      .base_light = sign > 0.0 ? 0.4 : 0.25,
                      .uneven = 0.5,
                      .shadow = 0.25,
                      .grains = 0.3,
                      .blur = 1.5,
                      .noise = 5.0,
                      .seed = ++seed};
    expect_accurate(scene, std::string(shape().name) + ", all together");
  }
}

TEST(Profile, SmallerPixelsMakeTheErrorSmaller) {
  // the same scene on 0.4 and 0.1 mm: an edge that was found to whole pixels would be off by 0.1 mm rms at
  // 0.4 mm
  const Scene fine{.outline = cap(0.070, 0.060, 4.0),
                   .pixel = 0.1e-3,
                   .width = 2400,
                   .height = 1120,
                   .axis_column = 1200.8,
                   .base_row = 941.4};
  const Scene coarse{.outline = fine.outline,
                     .pixel = 0.4e-3,
                     .width = 600,
                     .height = 280,
                     .axis_column = 300.2,
                     .base_row = 235.4};
  const OutlineError small = error_in(fine);
  const OutlineError large = error_in(coarse);
  EXPECT_LT(small.rms, 0.5 * large.rms);
  EXPECT_LT(small.largest, 0.5 * large.largest);
  EXPECT_LT(large.rms, 0.25 * coarse.pixel);
}

TEST(Profile, HeightToeAndVolumeAreThoseOfTheBody) {
  const Scene scene{.outline = cap(0.090, 0.045), .noise = 3.0};
  const Reading reading = reading_of(scene);
  EXPECT_NEAR(reading.outline.height(), 0.045, 0.1e-3);
  EXPECT_NEAR(reading.outline.toe(), 0.090, 0.2e-3);
  // a paraboloid fills half of its cylinder
  const double volume = 0.5 * std::numbers::pi * 0.090 * 0.090 * 0.045;
  EXPECT_NEAR(reading.volume / volume, 1.0, 0.005);
  EXPECT_EQ(reading.outline.points.front().z, 0.0);
  EXPECT_EQ(reading.outline.points.back().r, 0.0);
  EXPECT_TRUE(reading.warnings.empty());
}

TEST(Profile, MeanOfUnequalSidesLiesBetweenThemAndTheirHalfDifferenceIsTheUncertainty) {
  // 84 and 90 mm: about the middle between the feet both are half as much apart
  const Scene scene{.outline = cap(0.090, 0.045), .left = cap(0.084, 0.045)};
  const Reading reading = reading_of(scene);
  EXPECT_NEAR(reading.outline.toe(), 0.087, 0.3e-3);
  EXPECT_GT(reading.asymmetry, 0.0);
  for (const MeanPoint& point : reading.points) {
    EXPECT_LT((0.5 * (point.left + point.right) - point.place).norm(), 1e-12);
  }
  const Scene even{.outline = cap(0.090, 0.045)};
  EXPECT_GT(reading.asymmetry, 5.0 * reading_of(even).asymmetry);
}

TEST(Profile, ATiltedBaseLineIsToldAndTakenOut) {
  const Scene scene{.outline = cap(0.090, 0.045), .roll = 0.02};
  const Reading reading = reading_of(scene);
  EXPECT_NEAR(reading.base_tilt, 0.02, 1e-3);
  EXPECT_NEAR(reading.lean, 0.0, 5e-3);
}

TEST(Profile, ALeaningBodyIsWarnedOf) {
  // a cylinder sheared to the right by 5 mm in 70
  const Scene scene{.outline = {{0.040, 0.0}, {0.045, 0.070}, {0.005, 0.070}},
                    .left = Outline{{0.040, 0.0}, {0.035, 0.070}, {-0.005, 0.070}}};
  const Reading reading = reading_of(scene);
  EXPECT_NEAR(reading.lean, std::atan(5.0 / 70.0), 2e-3);
  ASSERT_FALSE(reading.warnings.empty());
  EXPECT_NE(reading.warnings.back().find("leans by 4.1 degrees to the right"), std::string::npos)
      << reading.warnings.back();
}

TEST(Profile, BaseRowAndAxisColumnAreTakenAsGiven) {
  const Scene scene{.outline = cap(0.090, 0.045)};
  ProfileOptions options;
  options.base_row = scene.base_row - 10.0;  // 2 mm higher
  options.axis_column = scene.axis_column + 5.0;
  const Reading reading = reading_of(scene, options);
  EXPECT_NEAR(reading.outline.height(), 0.043, 0.1e-3);
  // both feet are at z = 0; an axis 1 mm to the right is 2 mm nearer to the one than to the other
  EXPECT_NEAR(reading.points.front().left.x() - reading.points.front().right.x(), 2e-3, 0.1e-3);
}

TEST(Profile, PicturesWithoutMudAreRefused) {
  for (const bool base : {true, false}) {
    const Scene scene{
        .outline = cap(0.09, 0.045), .mud = false, .base = base, .uneven = 0.4, .grains = 0.2, .noise = 4.0};
    expect_refused(scene, Refusal::Kind::no_silhouette, "background");
  }
}

TEST(Profile, MudOfTheBackgroundsLightIsRefused) {
  const Scene scene{.outline = cap(0.09, 0.045), .mud_light = 0.585, .noise = 4.0};
  expect_refused(scene, Refusal::Kind::no_silhouette, "of its light");
}

TEST(Profile, MudCutByTheBorderIsRefused) {
  const Scene left{.outline = cap(0.09, 0.045), .axis_column = 350.0};
  expect_refused(left, Refusal::Kind::cut_by_border, "(left");
  const Scene right{.outline = cap(0.09, 0.045), .axis_column = 850.0};
  expect_refused(right, Refusal::Kind::cut_by_border, "right");
}

TEST(Profile, TwoBodiesAreRefusedUnlessOneIsLeftOut) {
  const Scene scene{.outline = cap(0.04, 0.045), .axis_column = 330.0};
  const Scene other{.outline = cap(0.03, 0.030), .axis_column = 900.0};
  const cv::Mat3b both(cv::Mat(cv::min(cv::Mat(render(scene)), cv::Mat(render(other)))));
  const Picture picture{"two.png", both};
  const View view = level_view(scene.pixel, picture.codes.size(), {});
  const PictureOutcome refused = read_profile(picture, view, {});
  ASSERT_FALSE(refused.reading.has_value());
  EXPECT_EQ(refused.reading.error().kind, Refusal::Kind::several_silhouettes);

  ProfileOptions options;
  options.looked.region = PixelArea{0, 0, 660, 560};
  const PictureOutcome region = read_profile(picture, view, options);
  ASSERT_TRUE(region.reading.has_value()) << region.reading.error().message;
  EXPECT_LT(error_of(region.reading->outline.points, scene.outline).largest, kLargestError);

  options.looked = {.region = {}, .ignored = {PixelArea{720, 250, 360, 219}}};
  const PictureOutcome ignored = read_profile(picture, view, options);
  ASSERT_TRUE(ignored.reading.has_value()) << ignored.reading.error().message;
  EXPECT_LT(error_of(ignored.reading->outline.points, scene.outline).largest, kLargestError);
}

TEST(Profile, ABodyInTheAirIsRefused) {
  const Scene scene{.outline = cap(0.09, 0.045), .base_row = 300.0};
  const Scene ground{.outline = cap(0.09, 0.045), .mud = false};
  cv::Mat3b picture = render(ground);
  render(scene).rowRange(0, 298).copyTo(picture.rowRange(0, 298));
  const PictureOutcome outcome =
      read_profile({"air.png", picture}, level_view(scene.pixel, picture.size(), {}), {});
  ASSERT_FALSE(outcome.reading.has_value());
  EXPECT_EQ(outcome.reading.error().kind, Refusal::Kind::not_on_base) << outcome.reading.error().message;
}

TEST(Profile, AVolumeBeyondTheLimitIsRefusedAndOneWithinIsTold) {
  const Scene scene{.outline = cap(0.090, 0.045)};
  const double volume = 0.5 * std::numbers::pi * 0.090 * 0.090 * 0.045;
  ProfileOptions options;
  options.mould_volume = 1.03 * volume;
  EXPECT_NEAR(reading_of(scene, options).volume_error.value_or(0.0), 1.0 / 1.03 - 1.0, 0.005);
  options.mould_volume = 1.08 * volume;
  expect_refused(scene, Refusal::Kind::volume, "at most 5 %", options);
}

TEST(Profile, ALowerEdgeThatIsNoLineIsRefusedWithoutABase) {
  // a disc in the air: no base beside it, none under it
  cv::Mat3b picture(560, 1200, cv::Vec3b(200, 200, 200));
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      if (std::hypot(row - 280.0, column - 600.0) < 180.0) picture(row, column) = cv::Vec3b(60, 60, 60);
    }
  }
  const PictureOutcome outcome =
      read_profile({"disc.png", picture}, level_view(2e-4, picture.size(), {}), {});
  ASSERT_FALSE(outcome.reading.has_value());
  EXPECT_EQ(outcome.reading.error().kind, Refusal::Kind::no_base_line) << outcome.reading.error().message;
}

}  // namespace
}  // namespace isotach::images
