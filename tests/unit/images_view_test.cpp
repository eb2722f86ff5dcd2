// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Views by rectangle and circle show places where a pinhole shows them, and what perspective adds is taken
// off.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/rendered_slump.hpp"
#include "images/apparent_contour.hpp"
#include "images/circle_view.hpp"
#include "images/mould_picture.hpp"
#include "images/profile.hpp"
#include "tests/outline_error.hpp"

namespace isotach::images {
namespace {

using rendered::cap;
using rendered::collar;
using rendered::error_of;
using rendered::Outline;
using rendered::Pinhole;
using rendered::pixel_of;
using rendered::Scene;

const cv::Size kSize(1200, 900);

Scene seen_from(double height, const Outline& outline = cap(0.09, 0.045)) {
  return {.outline = outline,
          .width = kSize.width,
          .height = kSize.height,
          .roll = 0.01,
          .pinhole = Pinhole{.distance = 0.8, .height = height, .pitch = 0.9 * height / 0.8, .yaw = 0.02},
          .base_behind = 0.02};
}

std::optional<View> by_rectangle(const Scene& scene, std::optional<double> distance) {
  const auto corner = [&](double x, double z) { return pixel_of(scene, Eigen::Vector2d(x, z)); };
  return rectangle_view({corner(-0.1, 0.08), corner(0.1, 0.08), corner(0.1, 0.0), corner(-0.1, 0.0)}, 0.2,
                        0.08, kSize, distance);
}

/// Points on the near half of a circle on the base, read to `off` pixels.
std::vector<Eigen::Vector2d> near_half(const Scene& scene, double radius, double off) {
  constexpr int kPoints = 24;
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < kPoints; ++k) {
    const double angle = std::numbers::pi * k / (kPoints - 1);
    points.push_back(
        pixel_of(scene, Eigen::Vector3d(radius * std::cos(angle), 0.0, radius * std::sin(angle))) +
        off * Eigen::Vector2d(std::sin(7.0 * k), std::cos(5.0 * k)));
  }
  return points;
}

double error_of_places(const View& view, const Scene& scene, double x_origin = 0.0) {
  double largest = 0.0;
  for (const double x : {-0.09, 0.0, 0.07}) {
    for (const double z : {0.0, 0.03, 0.07}) {
      const Eigen::Vector2d found = view.plane(pixel_of(scene, Eigen::Vector2d(x, z)));
      largest = std::max(largest, (found - Eigen::Vector2d(x - x_origin, z)).norm());
    }
  }
  return largest;
}

TEST(View, LevelViewBasedOnALineMeasuresAlongAndAcrossIt) {
  const View view = level_view(1e-3, cv::Size(101, 101), {}).based_on({10.0, 60.0}, {90.0, 120.0});
  // 3-4-5: along the line, and 5 pixels square to it, upwards
  EXPECT_NEAR(view.plane({50.0, 90.0}).y(), 0.0, 1e-12);
  EXPECT_NEAR(view.plane({50.0, 90.0}).x(), 0.05, 1e-12);
  EXPECT_NEAR(view.plane({53.0, 86.0}).y(), 0.005, 1e-12);
  EXPECT_NEAR(view.scale({20.0, 20.0}), 1e-3, 1e-12);
  EXPECT_LT((view.pixel(view.plane({12.0, 34.0})) - Eigen::Vector2d(12.0, 34.0)).norm(), 1e-9);
}

TEST(View, RectangleGivesThePlacesAndTheCameraOfAnyPinhole) {
  for (const double height : {0.0, 0.05, 0.2}) {
    const Scene scene = seen_from(height);
    const auto view = by_rectangle(scene, 0.8);
    ASSERT_TRUE(view.has_value());
    EXPECT_LT(error_of_places(*view, scene), 1e-6);
    ASSERT_TRUE(view->camera().has_value());
    EXPECT_NEAR(view->camera()->x, 0.0, 1e-4);
    EXPECT_NEAR(view->camera()->z, height, 1e-4);
  }
}

TEST(View, CornersInAnotherOrderAreRefused) {
  const std::array<Eigen::Vector2d, 4> corners{Eigen::Vector2d(100, 100), {500, 100}, {500, 300}, {100, 300}};
  EXPECT_TRUE(rectangle_view(corners, 0.2, 0.1, kSize, {}).has_value());
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
    auto swapped = corners;
    std::swap(swapped[static_cast<std::size_t>(a)], swapped[static_cast<std::size_t>(b)]);
    EXPECT_FALSE(rectangle_view(swapped, 0.2, 0.1, kSize, {}).has_value()) << a << b;
  }
}

TEST(View, CircleOnTheBaseGivesPlacesAxisAndCamera) {
  for (const double height : {0.05, 0.1, 0.2}) {
    const Scene scene = seen_from(height);
    const auto exact = base_circle_view(near_half(scene, 0.11, 0.0), 0.22, kSize, 0.8);
    ASSERT_TRUE(exact.has_value());
    EXPECT_LT(error_of_places(exact->view, scene), 1e-5);
    EXPECT_NEAR(exact->view.camera()->z, height, 1e-4);
    EXPECT_NEAR(exact->elevation, std::atan(height / 0.8), 1e-4);
    const auto read = base_circle_view(near_half(scene, 0.11, 0.5), 0.22, kSize, 0.8);
    ASSERT_TRUE(read.has_value());
    EXPECT_LT(error_of_places(read->view, scene), 0.3e-3);
  }
}

TEST(View, FewerThanFivePointsAreNoCircle) {
  auto points = near_half(seen_from(0.1), 0.11, 0.0);
  points.resize(4);
  EXPECT_FALSE(base_circle_view(points, 0.22, kSize, 0.8).has_value());
  EXPECT_FALSE(standing_disc_view(points, 0.22, kSize, {}).has_value());
}

TEST(View, StandingDiscTakesOutWhatTiltShortens) {
  // a disc seen by parallel rays, 4 degrees from the side and rolled: columns shrink by the cosine
  constexpr double kTilt = 0.07;
  constexpr double kScale = 0.2e-3;
  const auto seen = [&](double x, double z) {
    const Eigen::Rotation2Dd roll(0.3);
    return Eigen::Vector2d(Eigen::Vector2d(500.0, 400.0) +
                           roll * Eigen::Vector2d(x * std::cos(kTilt), -z) / kScale);
  };
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < 12; ++k) points.push_back(seen(0.05 * std::cos(0.5 * k), 0.05 * std::sin(0.5 * k)));
  const auto found = standing_disc_view(points, 0.1, kSize, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->elevation, kTilt, 2e-3);
  const View& view = found->view;
  EXPECT_NEAR((view.plane(seen(0.06, 0.0)) - view.plane(seen(-0.06, 0.0))).norm(), 0.12, 1e-5);
  EXPECT_NEAR((view.plane(seen(0.0, 0.07)) - view.plane(seen(0.0, 0.0))).norm(), 0.07, 1e-5);
}

TEST(ApparentContour, OfASphereIsALargerCircle) {
  // the cone of tangents from D to a sphere of radius R about the origin: R/sqrt(1 - (R/D)^2) in the plane
  constexpr double kRadius = 0.08;
  constexpr double kDistance = 0.6;
  const double seen = kRadius / std::sqrt(1.0 - std::pow(kRadius / kDistance, 2));
  Polyline contour;
  for (int k = 0; k <= 300; ++k) {
    const double angle = 0.5 * std::numbers::pi * k / 300;
    contour.emplace_back(seen * std::cos(angle), seen * std::sin(angle));
  }
  const Polyline meridian = meridian_of(contour, {kDistance, 0.0, 0.0}, 1e-3);
  for (const Eigen::Vector2d& point : meridian) {
    if (point.x() > 0.0) {
      EXPECT_NEAR(point.norm(), kRadius, 2e-5);
    }
  }
  EXPECT_LT(meridian.front().y(), 1e-3);
  // the rim that is seen is highest at R sqrt(1 - (R/D)^2); what is behind it is hidden
  EXPECT_NEAR(meridian.back().y(), kRadius * std::sqrt(1.0 - std::pow(kRadius / kDistance, 2)), 1e-4);
}

TEST(ApparentContour, DistanceForAnErrorOfTheRadius) {
  const double distance = distance_for(0.09, 0.5e-3);
  EXPECT_NEAR(0.09 / std::sqrt(1.0 - std::pow(0.09 / distance, 2)) - 0.09, 0.5e-3, 0.01e-3);
}

TEST(Profile, OutlinesByRectangleAndDistanceAreThoseOfTheBody) {
  for (const double height : {0.0, 0.09}) {
    for (const Outline& outline : {cap(0.090, 0.045), cap(0.070, 0.060, 4.0), collar(0.055, 0.039, 0.070)}) {
      const Scene scene = seen_from(height, outline);
      const PictureOutcome outcome =
          read_profile({"rectangle.png", render(scene)}, *by_rectangle(scene, 0.8), {});
      ASSERT_TRUE(outcome.reading.has_value()) << outcome.reading.error().message;
      const auto error = error_of(outcome.reading->outline.points, outline);
      EXPECT_LE(error.largest, 0.5e-3) << height;
      EXPECT_LE(error.missed, 0.5e-3) << height;
    }
  }
}

TEST(Profile, WithoutTheDistanceRadiiAreReadTooLargeByTheCube) {
  const Scene scene = seen_from(0.0);
  const PictureOutcome outcome = read_profile({"far.png", render(scene)}, *by_rectangle(scene, {}), {});
  ASSERT_TRUE(outcome.reading.has_value());
  // r^3/(2 D^2) = 0.57 mm, and as much again of the foot of 45 degrees that reaches before the plane of the
  // axis
  EXPECT_NEAR(outcome.reading->outline.toe() - 0.09, std::pow(0.09, 3) / (2.0 * 0.64), 0.25e-3);
}

TEST(Profile, OutlinesByACircleOnTheBaseAreThoseOfTheBody) {
  const Scene scene = seen_from(0.06);
  const auto circle = base_circle_view(near_half(scene, 0.11, 0.5), 0.22, kSize, 0.8);
  ASSERT_TRUE(circle.has_value());
  const PictureOutcome outcome = read_profile({"circle.png", render(scene)}, circle->view, {});
  ASSERT_TRUE(outcome.reading.has_value()) << outcome.reading.error().message;
  EXPECT_LE(error_of(outcome.reading->outline.points, scene.outline).largest, 0.5e-3);
}

TEST(MouldPicture, WidthIsReadToATenthOfAPixelAndGivesTheScale) {
  const Outline mould{{0.041, 0.0}, {0.041, 0.08}, {0.0, 0.08}};
  const Scene level{.outline = mould, .roll = 0.01, .uneven = 0.3, .noise = 4.0};
  const auto width = mould_width({"mould.png", render(level)}, {});
  ASSERT_TRUE(width.has_value()) << width.error().message;
  EXPECT_NEAR(width->pixels, 0.082 / level.pixel, 0.5);
  EXPECT_NEAR(width->taper, 0.0, 2e-3);
  EXPECT_NEAR(scale_of(*width, 0.082, {}), level.pixel, 1e-3 * level.pixel);

  const Scene near{.outline = mould, .width = 1200, .height = 900, .pinhole = Pinhole{.distance = 0.5}};
  const auto seen = mould_width({"near.png", render(near)}, {});
  ASSERT_TRUE(seen.has_value()) << seen.error().message;
  EXPECT_NEAR(scale_of(*seen, 0.082, 0.5), near.pixel, 1e-3 * near.pixel);
  EXPECT_LT(scale_of(*seen, 0.082, {}), near.pixel * (1.0 - 3e-3));  // the cylinder's rim is nearer
}

}  // namespace
}  // namespace isotach::images
