// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/rendered_slump.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

namespace isotach::rendered {
namespace {

constexpr int kSamples = 4;       // a pixel along each side
constexpr int kFractionBits = 6;  // of places in the finer picture
constexpr int kCirclePoints = 180;
constexpr double kBaseHalfWidth = 1.0;  // m
constexpr double kShadowBlur = 0.012;   // m

/// Shares of pixels that polygons cover.
class Coverage {
 public:
  explicit Coverage(const Scene& scene) : fine_(scene.height * kSamples, scene.width * kSamples, uchar{0}) {}
  void add(const std::vector<Eigen::Vector2d>& polygon) {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& place : polygon) {
      // the middle of the first pixel is (0, 0) before, the middle of the first sample after
      const Eigen::Vector2d at = ((place.array() + 0.5) * kSamples - 0.5) * (1 << kFractionBits);
      points.emplace_back(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
    }
    const std::vector<std::vector<cv::Point>> one{points};
    cv::fillPoly(fine_, one, cv::Scalar(255), cv::LINE_8, kFractionBits);
  }
  [[nodiscard]] cv::Mat1f share() const {
    cv::Mat1b codes;
    cv::resize(fine_, codes, cv::Size(), 1.0 / kSamples, 1.0 / kSamples, cv::INTER_AREA);
    cv::Mat1f coarse;
    codes.convertTo(coarse, CV_32F, 1.0 / 255.0);
    return coarse;
  }

 private:
  cv::Mat1b fine_;
};

std::vector<Eigen::Vector2d> circle(const Scene& scene, double radius, double z) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < kCirclePoints; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCirclePoints;
    points.push_back(pixel_of(scene, Eigen::Vector3d(radius * std::cos(angle), z, radius * std::sin(angle))));
  }
  return points;
}

std::vector<Eigen::Vector2d> hull_of(const std::vector<Eigen::Vector2d>& points) {
  std::vector<cv::Point2f> places;
  for (const Eigen::Vector2d& point : points) {
    places.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()));
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(places, hull);
  std::vector<Eigen::Vector2d> result;
  for (const cv::Point2f& point : hull) result.emplace_back(point.x, point.y);
  return result;
}

cv::Mat1f mud_share(const Scene& scene) {
  Coverage coverage(scene);
  if (!scene.mud) return coverage.share();
  if (scene.pinhole) {
    // the body is the union of frustums, each convex: its image is the hull of those of its two circles
    for (std::size_t i = 1; i < scene.outline.size(); ++i) {
      std::vector<Eigen::Vector2d> both = circle(scene, scene.outline[i - 1].r, scene.outline[i - 1].z);
      const std::vector<Eigen::Vector2d> upper = circle(scene, scene.outline[i].r, scene.outline[i].z);
      both.insert(both.end(), upper.begin(), upper.end());
      coverage.add(hull_of(both));
    }
    return coverage.share();
  }
  const Outline& left = scene.left ? *scene.left : scene.outline;
  std::vector<Eigen::Vector2d> polygon;
  for (const auto& point : left) polygon.push_back(pixel_of(scene, Eigen::Vector2d(-point.r, point.z)));
  for (auto point = scene.outline.rbegin(); point != scene.outline.rend(); ++point) {
    polygon.push_back(pixel_of(scene, Eigen::Vector2d(point->r, point->z)));
  }
  coverage.add(polygon);
  return coverage.share();
}

cv::Mat1f base_share(const Scene& scene) {
  Coverage coverage(scene);
  if (!scene.base) return coverage.share();
  const double far = scene.pinhole ? -scene.base_behind : 0.0;
  const Eigen::Vector2d left = pixel_of(scene, Eigen::Vector3d(-kBaseHalfWidth, 0.0, far));
  const Eigen::Vector2d right = pixel_of(scene, Eigen::Vector3d(kBaseHalfWidth, 0.0, far));
  const Eigen::Vector2d down(0.0, 2.0 * scene.height);
  coverage.add({left, right, right + down, left + down});
  return coverage.share();
}

void light_up(const Scene& scene, cv::Mat1f& light) {
  for (int row = 0; row < light.rows; ++row) {
    for (int column = 0; column < light.cols; ++column) {
      const double across = 0.7 * column / scene.width + 0.3 * row / scene.height;
      light(row, column) *= static_cast<float>(1.0 - scene.uneven * across);
    }
  }
}

unsigned char code_of(double light) {
  const double l = std::clamp(light, 0.0, 1.0);
  const double code = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
  return cv::saturate_cast<unsigned char>(255.0 * code);
}

}  // namespace

Outline cap(double radius, double height, double power) {
  // even steps of an angle, so that foot and top have points enough
  constexpr int kPoints = 200;
  Outline outline;
  for (int k = 0; k <= kPoints; ++k) {
    const double r = radius * std::cos(0.5 * std::numbers::pi * k / kPoints);
    outline.push_back({k == kPoints ? 0.0 : r, height * (1.0 - std::pow(r / radius, power))});
  }
  return outline;
}

Outline collar(double radius, double neck, double height) {
  constexpr int kPoints = 60;
  Outline outline;
  for (int k = 0; k <= kPoints; ++k) {
    const double share = static_cast<double>(k) / kPoints;
    outline.push_back({neck + (radius - neck) * std::pow(1.0 - share, 2), height / 3.0 * share});
  }
  outline.push_back({neck, height});
  outline.push_back({0.0, height});
  return outline;
}

Eigen::Vector2d pixel_of(const Scene& scene, const Eigen::Vector3d& place) {
  const Eigen::Rotation2Dd roll(scene.roll);
  if (!scene.pinhole) {
    return Eigen::Vector2d(scene.axis_column, scene.base_row) +
           roll * Eigen::Vector2d(place.x(), -place.y()) / scene.pixel;
  }
  const Pinhole& camera = *scene.pinhole;
  const double focal = camera.distance / scene.pixel;
  // in the camera's axes: right, down, ahead
  Eigen::Vector3d at(place.x(), camera.height - place.y(), camera.distance - place.z());
  at = Eigen::AngleAxisd(-camera.yaw, Eigen::Vector3d::UnitY()) * at;
  at = Eigen::AngleAxisd(camera.pitch, Eigen::Vector3d::UnitX()) * at;
  return Eigen::Vector2d(0.5 * (scene.width - 1), 0.5 * (scene.height - 1)) +
         roll * (focal * at.hnormalized());
}

Eigen::Vector2d pixel_of(const Scene& scene, const Eigen::Vector2d& place) {
  return pixel_of(scene, Eigen::Vector3d(place.x(), place.y(), 0.0));
}

cv::Mat3b render(const Scene& scene) {
  std::mt19937_64 random(scene.seed);
  std::normal_distribution<double> normal;
  const cv::Mat1f mud = mud_share(scene);
  const cv::Mat1f base = base_share(scene);

  cv::Mat1f grains(scene.height, scene.width, 0.0F);
  cv::Scalar deviation(1.0);
  if (scene.grains > 0.0) {
    for (float& grain : grains) grain = static_cast<float>(normal(random));
    cv::GaussianBlur(grains, grains, cv::Size(), std::max(0.4, 0.12e-3 / scene.pixel));
    cv::Scalar ignored;
    cv::meanStdDev(grains, ignored, deviation);
  }

  cv::Mat1f shadow(mud.size(), 0.0F);
  const cv::Mat1f shift = (cv::Mat1f(2, 3) << 1.0, 0.0, 0.02 / scene.pixel, 0.0, 1.0, -0.006 / scene.pixel);
  cv::warpAffine(mud, shadow, shift, mud.size());
  cv::GaussianBlur(shadow, shadow, cv::Size(), kShadowBlur / scene.pixel);

  cv::Mat1f light(mud.size());
  for (int row = 0; row < light.rows; ++row) {
    for (int column = 0; column < light.cols; ++column) {
      const double wall = scene.background_light * (1.0 - scene.shadow * shadow(row, column));
      const double grain = 1.0 + scene.grains * grains(row, column) / deviation[0];
      const double floor = scene.base_light * std::max(grain, 0.1);
      const double behind = wall + base(row, column) * (floor - wall);
      light(row, column) = static_cast<float>(behind + mud(row, column) * (scene.mud_light - behind));
    }
  }
  light_up(scene, light);
  cv::GaussianBlur(light, light, cv::Size(), scene.blur);
  cv::Mat3b picture(light.size());
  for (int row = 0; row < light.rows; ++row) {
    for (int column = 0; column < light.cols; ++column) {
      const unsigned char clean = code_of(light(row, column));
      for (int channel = 0; channel < 3; ++channel) {
        picture(row, column)[channel] =
            cv::saturate_cast<unsigned char>(clean + scene.noise * normal(random));
      }
    }
  }
  return picture;
}

}  // namespace isotach::rendered
