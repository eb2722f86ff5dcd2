// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/circle_view.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace isotach::images {
namespace {

constexpr std::size_t kLeastPoints = 5;  // an ellipse has five parameters

/// An ellipse in a picture.
struct Ellipse {
  Eigen::Vector2d middle;
  double major = 0.0;  // half axes (pixels)
  double minor = 0.0;
  double direction = 0.0;  // of the major axis, from columns towards rows (rad), -pi/2 to pi/2
};

std::optional<Ellipse> ellipse_through(const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < kLeastPoints) return {};
  std::vector<cv::Point2f> pixels;
  for (const Eigen::Vector2d& point : points) {
    pixels.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()));
  }
  const cv::RotatedRect box = cv::fitEllipseDirect(pixels);
  Ellipse ellipse{{box.center.x, box.center.y},
                  0.5 * box.size.width,
                  0.5 * box.size.height,
                  box.angle * std::numbers::pi / 180.0};
  if (ellipse.minor > ellipse.major) {
    std::swap(ellipse.major, ellipse.minor);
    ellipse.direction += 0.5 * std::numbers::pi;
  }
  if (!std::isfinite(ellipse.major) || !(ellipse.minor > 0.0)) return {};
  ellipse.direction = std::remainder(ellipse.direction, std::numbers::pi);
  return ellipse;
}

/// The camera over the base: its log focal length (pixels), its height (m) and how it is turned (an
/// angle-axis vector from the axes of the scene, x right, y up, towards the camera, to its own, x right, y
/// down, ahead).
using CameraParameters = std::array<double, 5>;

template <class T>
void turn_of(const T* parameters, std::array<T, 9>& rotation) {
  // level, the camera's axes are those of the scene with y and z reversed
  std::array<T, 9> turn;
  const std::array<T, 3> angles{parameters[2], parameters[3], parameters[4]};
  ceres::AngleAxisToRotationMatrix(angles.data(), ceres::RowMajorAdapter3x3(turn.data()));
  for (std::size_t i = 0; i < 3; ++i) {
    rotation[3 * i] = turn[3 * i];
    rotation[3 * i + 1] = -turn[3 * i + 1];
    rotation[3 * i + 2] = -turn[3 * i + 2];
  }
}

/// How far the point of the base that a pixel shows is from the circle, over its radius.
struct OffCircle {
  Eigen::Vector2d pixel;  // about the principal point
  double distance;
  double radius;

  template <class T>
  bool operator()(const T* parameters, T* residual) const {
    std::array<T, 9> rotation;
    turn_of(parameters, rotation);
    const T focal = ceres::exp(parameters[0]);
    const std::array<T, 3> ray{pixel.x() / focal, pixel.y() / focal, T(1.0)};
    std::array<T, 3> direction;
    for (std::size_t i = 0; i < 3; ++i) {
      direction[i] = rotation[i] * ray[0] + rotation[3 + i] * ray[1] + rotation[6 + i] * ray[2];
    }
    if (!(direction[1] < T(0.0))) return false;  // looks at or above the horizon
    const T along = -parameters[1] / direction[1];
    const T x = along * direction[0];
    const T y = distance + along * direction[2];
    residual[0] = ceres::sqrt(x * x + y * y) / radius - 1.0;
    return true;
  }
};

CameraParameters first_guess(const Ellipse& ellipse, const Eigen::Vector2d& principal, double distance,
                             double radius) {
  const double elevation = std::asin(std::min(ellipse.minor / ellipse.major, 1.0));
  const double height = distance * std::tan(elevation);
  const double focal = ellipse.major / radius * std::hypot(distance, height);
  const Eigen::Vector2d off = (ellipse.middle - principal) / focal;
  const double pitch = elevation - std::atan(off.y());  // downwards
  const double yaw = std::atan(off.x());
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(ellipse.direction, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  const Eigen::AngleAxisd angles(turn);
  const Eigen::Vector3d vector = angles.angle() * angles.axis();
  return {std::log(focal), height, vector.x(), vector.y(), vector.z()};
}

View view_of(const CameraParameters& parameters, const Eigen::Vector2d& principal, double distance) {
  std::array<double, 9> rotation;
  turn_of(parameters.data(), rotation);
  const Eigen::Matrix3d turn =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
  const Eigen::Vector3d centre(0.0, parameters[1], distance);
  Eigen::Matrix3d to_pixel;
  to_pixel << turn.col(0), turn.col(1), -turn * centre;
  const double focal = std::exp(parameters[0]);
  Eigen::Matrix3d intrinsic;
  intrinsic << focal, 0.0, principal.x(), 0.0, focal, principal.y(), 0.0, 0.0, 1.0;
  return {(intrinsic * to_pixel).inverse(), true, CameraPlace{distance, 0.0, parameters[1]}};
}

}  // namespace

std::optional<CircleView> base_circle_view(const std::vector<Eigen::Vector2d>& points, double diameter,
                                           cv::Size size, double camera_distance) {
  const std::optional<Ellipse> ellipse = ellipse_through(points);
  if (!ellipse) return {};
  const Eigen::Vector2d principal = middle_of(size);
  const double radius = 0.5 * diameter;
  CameraParameters parameters = first_guess(*ellipse, principal, camera_distance, radius);
  ceres::Problem problem;
  for (const Eigen::Vector2d& point : points) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<OffCircle, 1, 5>(
                                 new OffCircle{point - principal, camera_distance, radius}),
                             nullptr, parameters.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return {};
  const double scatter = radius * std::sqrt(2.0 * summary.final_cost / static_cast<double>(points.size()));
  return CircleView{view_of(parameters, principal, camera_distance), scatter,
                    std::atan(parameters[1] / camera_distance)};
}

std::optional<CircleView> standing_disc_view(const std::vector<Eigen::Vector2d>& points, double diameter,
                                             cv::Size size, std::optional<double> camera_distance) {
  const std::optional<Ellipse> ellipse = ellipse_through(points);
  if (!ellipse) return {};
  const Eigen::Vector2d along(std::cos(ellipse->direction), std::sin(ellipse->direction));
  const Eigen::Matrix2d on_major = along * along.transpose();
  const Eigen::Matrix2d round =
      0.5 * diameter *
      (on_major / ellipse->major + (Eigen::Matrix2d::Identity() - on_major) / ellipse->minor);
  Eigen::Matrix3d to_plane = Eigen::Matrix3d::Identity();
  to_plane.topLeftCorner<2, 2>() = Eigen::Vector2d(1.0, -1.0).asDiagonal() * round;
  double square = 0.0;
  for (const Eigen::Vector2d& point : points) {
    square += std::pow((round * (point - ellipse->middle)).norm() - 0.5 * diameter, 2);
  }
  const double scatter = std::sqrt(square / static_cast<double>(points.size()));
  const double tilt = std::acos(std::min(ellipse->minor / ellipse->major, 1.0));
  if (!camera_distance) return CircleView{View{to_plane, false}, scatter, tilt};
  const Eigen::Vector2d foot = (to_plane * middle_of(size).homogeneous()).hnormalized();
  return CircleView{View{to_plane, false, CameraPlace{*camera_distance, foot.x(), foot.y()}}, scatter, tilt};
}

}  // namespace isotach::images
