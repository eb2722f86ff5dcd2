// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/view.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace isotach::images {
namespace {

Eigen::Vector2d applied(const Eigen::Matrix3d& map, const Eigen::Vector2d& at) {
  return (map * at.homogeneous()).hnormalized();
}

/// The camera's centre in the axes of a plane of which `to_pixel` is the image, by its distance from the
/// plane: to_pixel = K [r1 r2 t] up to a factor, K = diag(f, f, 1) about the principal point. The distance
/// grows with the focal length f, nearly in proportion, so that a few corrections find f.
CameraPlace camera_of(const Eigen::Matrix3d& to_pixel, const Eigen::Vector2d& principal, double distance) {
  constexpr int kCorrections = 50;
  Eigen::Matrix3d about = to_pixel;
  about.row(0) -= principal.x() * to_pixel.row(2);
  about.row(1) -= principal.y() * to_pixel.row(2);
  double focal = distance * about.col(0).head<2>().norm() / about(2, 2);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int i = 0; i < kCorrections; ++i) {
    Eigen::Matrix3d pose = Eigen::Vector3d(1.0 / focal, 1.0 / focal, 1.0).asDiagonal() * about;
    pose *= 2.0 / (pose.col(0).norm() + pose.col(1).norm());
    if (pose(2, 2) < 0.0) pose = -pose;  // the plane is in front of the camera
    Eigen::Matrix3d axes;
    axes << pose.col(0), pose.col(1), pose.col(0).cross(pose.col(1));
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
    centre = -rotation.transpose() * pose.col(2);
    const double ratio = distance / std::abs(centre.z());
    focal *= ratio;
    if (std::abs(ratio - 1.0) < 1e-12) break;
  }
  return {distance, centre.x(), centre.y()};
}

}  // namespace

Eigen::Vector2d middle_of(cv::Size size) {
  return {0.5 * (size.width - 1), 0.5 * (size.height - 1)};
}

View::View(const Eigen::Matrix3d& to_plane, bool base_known, std::optional<CameraPlace> camera)
    : to_plane_(to_plane), to_pixel_(to_plane.inverse()), base_known_(base_known), camera_(camera) {}

Eigen::Vector2d View::plane(const Eigen::Vector2d& pixel) const {
  return applied(to_plane_, pixel);
}

Eigen::Vector2d View::pixel(const Eigen::Vector2d& place) const {
  return applied(to_pixel_, place);
}

double View::scale(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d right =
      plane(pixel + Eigen::Vector2d(0.5, 0.0)) - plane(pixel - Eigen::Vector2d(0.5, 0.0));
  const Eigen::Vector2d down =
      plane(pixel + Eigen::Vector2d(0.0, 0.5)) - plane(pixel - Eigen::Vector2d(0.0, 0.5));
  return std::sqrt(std::abs(right.x() * down.y() - right.y() * down.x()));
}

View View::based_on(const Eigen::Vector2d& left, const Eigen::Vector2d& right) const {
  const Eigen::Vector2d origin = plane(left);
  const Eigen::Vector2d along = (plane(right) - origin).normalized();
  Eigen::Matrix3d turn;
  turn << along.x(), along.y(), -along.dot(origin), -along.y(), along.x(),
      along.y() * origin.x() - along.x() * origin.y(), 0.0, 0.0, 1.0;
  std::optional<CameraPlace> camera = camera_;
  if (camera) {
    const Eigen::Vector2d foot = applied(turn, {camera->x, camera->z});
    camera->x = foot.x();
    camera->z = foot.y();
  }
  return {turn * to_plane_, true, camera};
}

View level_view(double scale, cv::Size size, std::optional<double> camera_distance) {
  const Eigen::Matrix3d to_plane = Eigen::Vector3d(scale, -scale, 1.0).asDiagonal();
  if (!camera_distance) return {to_plane, false};
  const Eigen::Vector2d foot = applied(to_plane, middle_of(size));
  return {to_plane, false, CameraPlace{*camera_distance, foot.x(), foot.y()}};
}

std::optional<View> rectangle_view(const std::array<Eigen::Vector2d, 4>& corners, double width, double height,
                                   cv::Size size, std::optional<double> camera_distance) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % 4] - corners[i];
    const Eigen::Vector2d next = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    if (!(side.x() * next.y() - side.y() * next.x() > 0.0)) return {};  // clockwise, rows downwards
  }
  if (!(corners[0].y() < corners[3].y() && corners[0].x() < corners[1].x())) return {};
  const Eigen::Vector2d mean = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  // about the mean, in pixels: single precision is enough for places, not for places less an offset
  std::array<cv::Point2f, 4> from;
  for (std::size_t i = 0; i < 4; ++i) {
    from[i] = {static_cast<float>(corners[i].x() - mean.x()), static_cast<float>(corners[i].y() - mean.y())};
  }
  const std::array<cv::Point2f, 4> unit{cv::Point2f{-0.5F, 1.0F}, {0.5F, 1.0F}, {0.5F, 0.0F}, {-0.5F, 0.0F}};
  const cv::Mat1d found = cv::getPerspectiveTransform(from.data(), unit.data());
  Eigen::Matrix3d map;
  for (int i = 0; i < 3; ++i) map.row(i) << found(i, 0), found(i, 1), found(i, 2);
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift.topRightCorner<2, 1>() = -mean;
  const Eigen::Matrix3d to_plane = Eigen::Vector3d(width, height, 1.0).asDiagonal() * map * shift;
  if (!camera_distance) return View{to_plane, true};
  return View{to_plane, true, camera_of(to_plane.inverse(), middle_of(size), *camera_distance)};
}

}  // namespace isotach::images
